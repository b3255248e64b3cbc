// What a test has to know of scripts, read by TypeScript's parser. For each file of the arguments
// behind the folder of the packages: its functions and how many lines they have, the values of the
// constants that it declares at its top, its numbers and its texts.

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
