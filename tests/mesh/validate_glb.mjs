// SPDX-License-Identifier: Apache-2.0
// Prints what the Khronos validator says about a GLB file; exit 0 when it has no error or warning.
// usage: node validate_glb.mjs <folder with node_modules> <file.glb>
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const [folder, file] = process.argv.slice(2);
const validator = createRequire(folder + "/x.js")("gltf-validator");
const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
console.log(JSON.stringify(report.issues, null, 1));
process.exit(report.issues.numErrors + report.issues.numWarnings === 0 ? 0 : 1);
