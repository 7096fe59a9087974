// The worker that runs Python: it loads Pyodide and the program, then answers one question a message.

const tell = (message) => self.postMessage(message);
const plainFetch = self.fetch.bind(self);
const loaded = {bytes: 0, total: 0};
let answers = null; // Python's side: a name and JSON in, JSON out

class Broken extends Error {} // its message is a sentence for the reader

// Pyodide waits for ever where a file of it is wrong, so what goes wrong is heard here as well.
let giveUp;
const trouble = new Promise((_, reject) => { giveUp = reject; });
trouble.catch(() => {});
self.addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  giveUp(event.reason);
});

function stage(sentence) {
  tell({progress: {stage: "loading", done: loaded.bytes, total: loaded.total, sentence}});
}

const millions = (bytes) => (bytes / 1e6).toFixed(1);

// The check sum of zlib: whether a file is whole, in a moment.
class Adler32 {
  a = 1;
  b = 0;

  add(bytes) {
    for (let start = 0; start < bytes.length; start += 3800) { // so long the sums stay exact
      const end = Math.min(start + 3800, bytes.length);
      for (let i = start; i < end; i++) {
        this.a += bytes[i];
        this.b += this.a;
      }
      this.a %= 65521;
      this.b %= 65521;
    }
  }

  get value() {
    return this.b * 65536 + this.a;
  }
}

// Fetches a file of this folder, counts its bytes as they come, and refuses one that is damaged.
async function fetched(url, options, sums) {
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
  const sum = new Adler32();
  const counter = new TransformStream({
    transform(part, controller) {
      sum.add(part);
      loaded.bytes += part.length;
      stage(`Loading Python, ${millions(loaded.bytes)} of ${millions(loaded.total)} MB`);
      controller.enqueue(part);
    },
    flush() {
      if (sums[name] !== sum.value) {
        giveUp(new Broken(`file (${name}): it is damaged; copy the folder anew`));
      }
    },
  });
  const kind = name.endsWith(".wasm") ? "application/wasm" : "application/octet-stream";
  return new Response(answer.body.pipeThrough(counter), {headers: {"Content-Type": kind}});
}

async function contents() {
  let answer;
  try {
    answer = await plainFetch("folder.json");
  } catch {
    throw new Broken("file (folder.json): it cannot be fetched; look at the network, then try again");
  }
  try {
    return await answer.json();
  } catch {
    throw new Broken("file (folder.json): it cannot be read; copy the whole folder");
  }
}

async function load() {
  const {python, program, bytes, sums} = await contents();
  const counted = [...python, program].filter((name) => !name.endsWith(".mjs"));
  loaded.total = counted.reduce((sum, name) => sum + bytes[name], 0);
  self.fetch = (url, options) => fetched(url, options, sums).catch((error) => {
    giveUp(error);
    throw error;
  });
  const packed = self.fetch(program).then((one) => one.arrayBuffer());
  let loadPyodide;
  try {
    ({loadPyodide} = await import("./pyodide.mjs"));
  } catch {
    throw new Broken("file (pyodide.mjs): it cannot be loaded; copy the whole folder");
  }
  const running = await loadPyodide({indexURL: new URL(".", self.location).href});
  running.unpackArchive(await packed, "zip", {extractDir: "/nmatrix"});
  self.fetch = plainFetch;
  answers = running.runPython(`
import gc, json, sys

sys.path.insert(0, "/nmatrix")
from nmatrix.cli.web import desk

opened = desk()
gc.freeze()
lambda name, asked: json.dumps(opened.answer(name, json.loads(asked)))
`);
}

const DAMAGED = "Python: it does not start in this browser; copy the folder anew, or use a newer browser";

const started = Promise.race([load(), trouble]).then(
  () => tell({ready: true}),
  (error) => tell({failed: error instanceof Broken ? error.message : DAMAGED}),
);

self.onmessage = async ({data: {id, name, asked}}) => {
  await started;
  if (answers === null) return;
  try {
    tell({id, answer: answers(name, JSON.stringify(asked))});
  } catch {
    // Python itself has stopped: memory or stack ran out. Another worker begins where this one ends.
    tell({id, died: true});
  }
};
