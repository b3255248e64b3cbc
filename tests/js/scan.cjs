// Prints data about scripts for a test, read with TypeScript's parser. The arguments are the folder
// of the packages and then the files. For each file it prints the functions with their first lines
// and their lengths in lines, and the values of the top-level constants.

const {readFileSync} = require("fs");
const ts = require(`${process.argv[2]}/typescript`);

function scan(path) {
  const file = ts.createSourceFile(path, readFileSync(path, "utf8"), ts.ScriptTarget.Latest, true);
  const line = at => file.getLineAndCharacterOfPosition(at).line + 1;
  const functions = [];
  const visit = node => {
    if (ts.isFunctionLike(node) && node.body) {
      const [first, last] = [line(node.getStart(file)), line(node.end)];
      const name = (node.name || node.parent.name)?.getText(file) || "";
      functions.push([name, first, last - first + 1]);
    }
    ts.forEachChild(node, visit);
  };
  visit(file);
  const constants = file.statements
    .filter(ts.isVariableStatement)
    .flatMap(statement => [...statement.declarationList.declarations])
    .filter(one => ts.isIdentifier(one.name) && one.initializer)
    .map(one => [one.name.text, one.initializer.getText(file)]);
  return {functions, constants};
}

const found = Object.fromEntries(process.argv.slice(3).map(path => [path, scan(path)]));
console.log(JSON.stringify(found));
