// The search of the site without a browser: node search.js WORKER INDEX < lines of words
// Prints for each line the pages that are found, the first one first, as a list of JSON.
const fs = require("fs");
const [worker, index] = process.argv.slice(2);
const { config, docs } = JSON.parse(fs.readFileSync(index, "utf8"));
let answer, handle;
globalThis.self = globalThis;
globalThis.addEventListener = (_, listener) => (handle = listener);
globalThis.postMessage = (message) => answer(message);
globalThis.importScripts = () => {};
(0, eval)(fs.readFileSync(worker, "utf8"));
const ask = (type, data) =>
  new Promise((resolve) => {
    answer = resolve;
    handle({ data: { type, data } });
  });
(async () => {
  await ask(0, { config, docs, options: { suggest: false } });
  for (const words of fs.readFileSync(0, "utf8").trim().split("\n")) {
    const { data } = await ask(2, words);
    console.log(JSON.stringify(data.items.map((sections) => sections[0].location.split("#")[0])));
  }
})();
