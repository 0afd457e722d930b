// Runs the Khronos glTF validator on files: node validate_gltf.mjs FILE... One line of JSON for each, with the counts of
// errors, warnings, infos and hints, and the messages. Exit code 2 when the validator is not installed.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

let validator;
try {
  const tools = fileURLToPath(new URL('../../.tools/', import.meta.url));
  validator = createRequire(tools)('gltf-validator');
} catch (error) {
  console.error(`gltf-validator is not installed: run script/setup (${error.code})`);
  process.exit(2);
}
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), { uri: file, maxIssues: 20 });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  console.log(JSON.stringify({ file, numErrors, numWarnings, numInfos, numHints, messages }));
}
