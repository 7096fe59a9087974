// The worker that runs Python: it loads Pyodide and the program, then answers one question a message.
const counted = {loaded: 0, total: 0};

const tell = (message) => self.postMessage(message);

function stage(sentence) {
  tell({progress: {stage: "loading", done: counted.loaded, total: counted.total, sentence}});
}

class Broken extends Error {}

// Fetches a file of this folder, counts its bytes as they come, and refuses one that was cut.
async function fetched(url, options, bytes) {
  const name = new URL(url, self.location).pathname.split("/").pop();
  let answer;
  try {
    answer = await plainFetch(url, options);
  } catch {
    throw new Broken(`file (${name}): it cannot be fetched; look at the network, then try again`);
  }
  if (!answer.ok) {
    throw new Broken(`file (${name}): the server answers ${answer.status}; copy the whole folder`);
  }
  let length = 0;
  const counter = new TransformStream({
    transform(part, controller) {
      length += part.length;
      counted.loaded += part.length;
      stage(`Loading Python, ${(counted.loaded / 1e6).toFixed(1)} of ${(counted.total / 1e6).toFixed(1)} MB`);
      controller.enqueue(part);
    },
    flush(controller) {
      if (bytes[name] !== undefined && bytes[name] !== length) {
        broken = new Broken(`file (${name}): it has ${length} bytes in place of ${bytes[name]}; copy the folder anew`);
        controller.error(broken);
      }
    },
  });
  const kinds = {wasm: "application/wasm", json: "application/json"};
  const kind = kinds[name.split(".").pop()] || "application/octet-stream";
  return new Response(answer.body.pipeThrough(counter), {headers: {"Content-Type": kind}});
}

const plainFetch = self.fetch.bind(self);
let broken = null; // what was wrong with a file, which Pyodide would tell in its own words
let answers = null;

async function start() {
  const told = await (await plainFetch("folder.json").catch(() => {
    throw new Broken("file (folder.json): it cannot be fetched; look at the network, then try again");
  })).json().catch(() => {
    throw new Broken("file (folder.json): it cannot be read; copy the whole folder");
  });
  const streamed = [...told.python, told.program].filter((name) => !name.endsWith(".mjs"));
  counted.total = streamed.reduce((sum, name) => sum + told.bytes[name], 0);
  self.fetch = (url, options) => fetched(url, options, told.bytes).catch((error) => {
    broken = error;
    throw error;
  });
  const program = self.fetch(new URL(told.program, self.location)).then((one) => one.arrayBuffer());
  program.catch(() => {});
  let loadPyodide;
  try {
    ({loadPyodide} = await import("./pyodide.mjs"));
  } catch {
    throw new Broken("file (pyodide.mjs): it cannot be loaded; copy the whole folder");
  }
  const python = await loadPyodide({indexURL: new URL(".", self.location).href});
  stage("Starting the program");
  python.unpackArchive(await program, "zip", {extractDir: "/nmatrix"});
  answers = python.runPython(`
import gc, json, sys

sys.path.insert(0, "/nmatrix")
from nmatrix.cli.web import desk

opened = desk()
gc.freeze()
lambda name, asked: json.dumps(opened.answer(name, json.loads(asked)))
`);
  self.fetch = plainFetch;
  tell({ready: true});
}

const started = start().catch((error) => {
  const known = broken || (error instanceof Broken ? error : null);
  const sentence = known ? known.message : "Python: it does not start in this browser; reload the page, copy the folder anew, or use a newer browser";
  tell({failed: sentence});
  return "failed";
});

self.onmessage = async ({data: {id, name, asked}}) => {
  if (await started === "failed") return;
  try {
    tell({id, answer: answers(name, JSON.stringify(asked))});
  } catch (error) {
    // Python itself has stopped: memory or stack ran out. Another worker begins where this one ends.
    tell({id, died: true});
  }
};
