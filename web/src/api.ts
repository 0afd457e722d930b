export * from "../../build/api/studio_types";
