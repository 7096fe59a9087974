import {ask, progress} from "./engine.js";

const at = (id) => document.getElementById(id);
progress((told) => { at("state").textContent = told.failed || told.sentence || ""; });
at("ask").addEventListener("submit", async (event) => {
  event.preventDefault();
  try {
    const {html, text, err} = await ask("shown", {words: at("line").value});
    at("answer").innerHTML = html;
    at("answer").append(Object.assign(document.createElement("pre"), {textContent: text + err}));
  } catch (error) {
    at("answer").textContent = error.message;
  }
});
