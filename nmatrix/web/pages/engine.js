// The one place that talks to the worker: questions in, answers out, and a new worker if one is lost.
//
//   await ask("shown", {words: ["world", "--scale", "1", "2", "1"]})   an answer, or an EngineError
//   progress((state) => …)   {stage, done, total, sentence} | {ready} | {failed} | {slow} | {restarted}
//   stop()                   ends what is computed; the session goes on
//   restart()                loads anew, after a failure or by wish
//
// Each sentence is for the reader; `failed` means that no Python runs, `slow` that one may stop.

export class EngineError extends Error {
  constructor(sentence, code = null) {
    super(sentence);
    this.code = code; // as a command's exit code, where Python refused; null where it did not run
  }
}

const PATIENCE = 20_000; // milliseconds after which one may stop a computation
const LONGEST = 120_000; // after which it is stopped
const LOADING = 120_000; // without a byte more, after which loading has failed
const listeners = new Set();
const waiting = new Map(); // questions by their numbers, in the order in which they were asked
let worker = null;
let state = {stage: "idle", done: 0, total: 0, sentence: ""};
let session = ""; // the statements of the calculator, for the worker after this one
let number = 0;
let current = null; // the number of the question that is being answered
let alarms = [];
let usable = true; // whether the present worker may be asked

const publish = (told) => {
  state = told;
  for (const one of listeners) one(told);
};

export function progress(callback) {
  listeners.add(callback);
  callback(state);
  return () => listeners.delete(callback);
}

export function ask(name, asked = {}) {
  return new Promise((resolve, reject) => {
    if (state.failed) {
      reject(new EngineError(state.failed));
      return;
    }
    if (worker === null) begin();
    number += 1;
    waiting.set(number, {name, asked, resolve, reject});
    advance();
  });
}

export function stop() {
  if (current === null) return;
  lose("stopped: the computation was ended; what was named in the session is kept");
}

export function restart() {
  abandon();
  refuse("restarted: the program was loaded anew; ask once more");
  begin();
}

export function start() {
  if (worker === null && !state.failed) begin();
}

export function impediment() {
  if (location.protocol === "file:") {
    return "This page was opened as a file, where browsers run no Python: serve this folder with python -m http.server and open the address that it prints.";
  }
  if (typeof WebAssembly !== "object" || typeof WebAssembly.instantiate !== "function") {
    return "This browser has no WebAssembly, which the Python of this page needs: allow it, or use another browser.";
  }
  if (typeof Worker !== "function" || typeof TransformStream !== "function") {
    return "This browser has no module workers, which the Python of this page needs: use a newer one.";
  }
  return "";
}

function begin() {
  const why = impediment();
  if (why) {
    fail(why);
    return;
  }
  try {
    worker = new Worker(new URL("worker.js", import.meta.url), {type: "module"});
  } catch {
    fail("This browser refuses the worker that the Python of this page needs: use a newer one.");
    return;
  }
  usable = false;
  publish({stage: "loading", done: 0, total: 0, sentence: "Loading Python"});
  watch();
  worker.onmessage = ({data}) => heard(data);
  worker.onerror = (event) => {
    event.preventDefault();
    if (usable) lose("stopped: the program ran out of memory; ask for less at once");
    else fail("file (worker.js): it cannot be loaded; copy the whole folder");
  };
}

function heard(data) {
  if (data.progress) {
    watch();
    publish(data.progress);
  } else if (data.failed) {
    fail(data.failed);
  } else if (data.ready) {
    quiet();
    usable = true;
    if (session) resume();
    else opened();
  } else if (data.died) {
    lose("stopped: the program ran out of memory or depth; ask for less at once");
  } else {
    answered(data.id, JSON.parse(data.answer));
  }
}

function answered(id, answer) {
  if (id === 0) { // the session of the worker before this one
    quiet();
    current = null;
    opened();
    return;
  }
  const question = waiting.get(id);
  waiting.delete(id);
  current = null;
  quiet();
  if (state.slow) publish({ready: true});
  if (typeof answer.session === "string") session = answer.session;
  if (question) {
    if (answer.error !== undefined) question.reject(new EngineError(answer.error, answer.code));
    else question.resolve(answer);
  }
  advance();
}

function resume() {
  current = 0;
  alarms = [setTimeout(() => {
    session = "";
    lose("stopped: the session took too long to come back; it begins anew");
  }, LONGEST)];
  worker.postMessage({id: 0, name: "resume", asked: {text: session}});
}

function opened() {
  publish({ready: true});
  advance();
}

// One question is with the worker at a time, so that only that one is lost with it.
function advance() {
  if (!usable || current !== null) return;
  const next = waiting.entries().next().value;
  if (next === undefined) return;
  const [id, {name, asked}] = next;
  current = id;
  alarms = [
    setTimeout(() => publish({slow: true, sentence: "This takes long. You may stop it; the session is kept."}), PATIENCE),
    setTimeout(() => lose(`stopped: it took longer than ${LONGEST / 1000} seconds; ask for less at once`), LONGEST),
  ];
  worker.postMessage({id, name, asked});
}

function lose(sentence) {
  const lost = waiting.get(current);
  waiting.delete(current);
  abandon();
  if (lost) lost.reject(new EngineError(sentence));
  publish({restarted: true, sentence});
  begin();
}

function abandon() {
  quiet();
  current = null;
  usable = false;
  if (worker !== null) worker.terminate();
  worker = null;
}

function fail(sentence) {
  abandon();
  publish({failed: sentence});
  refuse(sentence);
}

function refuse(sentence) {
  for (const one of waiting.values()) one.reject(new EngineError(sentence));
  waiting.clear();
}

function watch() {
  quiet();
  alarms = [setTimeout(() => fail("Python: nothing more of it has come for two minutes; look at the network, then try again"), LOADING)];
}

function quiet() {
  alarms.forEach(clearTimeout);
  alarms = [];
}
