// mathml.js - LaTeX as MathML: reads a list of [formula, is display] from standard input, JSON both ways.
const katex = require(process.env.KATEX || '/usr/share/nodejs/katex');
const formulas = JSON.parse(require('fs').readFileSync(0, 'utf8'));
const typeset = ([formula, isDisplay]) =>
    katex.renderToString(formula, {displayMode: isDisplay, output: 'mathml', strict: 'error', trust: false});
process.stdout.write(JSON.stringify(formulas.map(typeset)));
