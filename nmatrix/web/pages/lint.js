// Shaders are linted in a terminal; the program itself tells what it misses here.
import {at, catalogue, commandLine, sentence} from "./parts.js";

at("lint-commands").append(commandLine("nmatrix lint phong.vert phong.frag"), commandLine("nmatrix lint - < phong.frag"));
catalogue(({commands}) => {
  const why = commands.find((one) => one.name === "lint")?.why_not;
  at("lint-why").hidden = !why;
  at("lint-why").textContent = sentence(why ?? "");
});
