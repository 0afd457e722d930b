// Which view stands in the middle of the page.
export { createView } from "./view_stand_in";
