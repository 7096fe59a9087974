// What is this matrix? Text as any program prints it, and every reading of it.
import {answer, at, examples, keep} from "./parts.js";

const EXAMPLES = [
  ["a turn, rounded", "0.7071 -0.7071 0 0\n0.7071  0.7071 0 0\n0       0      1 0\n0       0      0 1"],
  ["three.js", '{"elements":[0,1,0,0,-2,0,0,0,0,0,1,0,3,0,0,1]}'],
  ["GLSL", "mat4(1.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 4.0, 0.0, -3.0, 1.0)"],
  ["a lens", "1.7321 0 0 0\n0 1.7321 0 0\n0 0 -1.0101 -0.10101\n0 0 -1 0"],
  ["NumPy", "array([[ 0.36, 0.48, -0.8 ],\n       [-0.8 , 0.6 ,  0.  ],\n       [ 0.48, 0.64,  0.6 ]])"],
];
const matrix = at("identify-matrix");
const layout = at("identify-layout");
let shown = null;

function run() {
  const text = matrix.value.trim();
  if (!text) {
    matrix.focus();
    return;
  }
  keep("identify", {m: text, layout: layout.value});
  shown = text + layout.value;
  const read = layout.value ? ["--input-layout", layout.value] : [];
  answer(at("identify-answer"), "shown", {words: ["identify", ...read, "--", text]});
}

at("identify-form").addEventListener("submit", (event) => {
  event.preventDefault();
  run();
});
matrix.addEventListener("keydown", (event) => {
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) run();
});
matrix.addEventListener("paste", () => setTimeout(() => matrix.value.trim() && run()));
examples(at("identify-examples"), EXAMPLES, (text) => {
  matrix.value = text;
  layout.value = "";
  run();
});

export function open(asked) {
  const text = asked.get("m");
  if (text === null || text + (asked.get("layout") ?? "") === shown) return;
  matrix.value = text;
  layout.value = asked.get("layout") ?? "";
  run();
}
