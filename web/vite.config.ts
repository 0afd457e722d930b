import { defineConfig } from "vitest/config";

export default defineConfig({
  base: "./",
  build: { outDir: "../build/studio-page", emptyOutDir: true, sourcemap: false, target: "es2022", assetsInlineLimit: 0 },
  test: { include: ["tests/**/*.test.ts", "tests/**/*.test.tsx"], environment: "happy-dom" },
});
