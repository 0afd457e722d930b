// Tests of the built page in a real Chromium: npm run e2e.
import { defineConfig } from "vitest/config";

export default defineConfig({
  // Tried again once: a machine that draws without a graphics card may stall for seconds.
  test: { retry: 1, include: ["e2e/**/*.test.ts"], environment: "node", testTimeout: 240_000, hookTimeout: 120_000, fileParallelism: false, expect: { poll: { timeout: 10_000 } } },
});
