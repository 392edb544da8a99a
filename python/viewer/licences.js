// Collects the licences of the bundled libraries, and the style sheet of uPlot, beside the bundle.
import { copyFileSync, readFileSync, writeFileSync } from "node:fs";

const page = "../hydrodae/viewer/page";
const texts = ["three", "uplot"].map((name) => {
  const about = JSON.parse(readFileSync(`node_modules/${name}/package.json`, "utf8"));
  const licence = readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim();
  return `${name} ${about.version}\n\n${licence}\n`;
});
writeFileSync(`${page}/libraries.LICENSE.txt`, texts.join("\n----\n\n"));
copyFileSync("node_modules/uplot/dist/uPlot.min.css", `${page}/uplot.min.css`);
