// Loads the editor into the page, and says in words what goes wrong on the way.
"use strict";

const WASM = "sheetwright_bg.wasm";
/** How large the program is; what arrives is counted, since servers may pack it. */
const WASM_BYTES = Number("{{wasm-bytes}}");

const part = (id) => document.getElementById(id);

/** Shows a notice over everything. `fault` is for whoever can make something of it. */
function say(title, text, fault) {
  part("notice").hidden = false;
  part("title").textContent = title;
  part("text").textContent = text;
  part("progress").hidden = true;
  part("reload").hidden = false;
  part("details").hidden = !fault;
  part("fault").textContent = fault ?? "";
  document.documentElement.dataset.failed = "true";
}

/** Says that the program has a fault, which it tells by an attribute of the page. */
function watchForFaults() {
  const look = () => {
    const fault = document.documentElement.dataset.fault;
    if (fault) {
      say(
        "Sheetwright had to stop",
        "The program has a fault. Your work was kept while you drew: load the page again, and it comes back.",
        fault,
      );
    }
  };
  const attributes = ["data-fault"];
  new MutationObserver(look).observe(document.documentElement, { attributeFilter: attributes });
}

/** Whether there is anything to draw with. */
async function hasGraphics() {
  if (await navigator.gpu?.requestAdapter().catch(() => null)) {
    return true;
  }
  return document.createElement("canvas").getContext("webgl2") !== null;
}

/** The program, counted as it arrives. */
async function fetched() {
  const response = await fetch(WASM);
  if (!response.ok) {
    throw new Error(`${WASM}: ${response.status} ${response.statusText}`);
  }
  let count = 0;
  const counter = new TransformStream({
    transform(chunk, out) {
      count += chunk.byteLength;
      part("progress").value = Math.min(1, count / WASM_BYTES);
      out.enqueue(chunk);
    },
  });
  // Whatever kind of file the server takes it for.
  const headers = { "content-type": "application/wasm" };
  return new Response(response.body.pipeThrough(counter), { headers });
}

/** A place in the storage for the work of this tab, and those of other tabs that run. */
async function slots() {
  const own = `${Date.now().toString(36)}-${Math.floor(Math.random() * 2 ** 32).toString(36)}`;
  const prefix = "sheetwright/";
  if (!navigator.locks) {
    return { own, running: [] };
  }
  // Held until the tab ends, however it ends.
  await new Promise((held) => {
    navigator.locks.request(prefix + own, () => new Promise(() => held()));
  });
  const names = (await navigator.locks.query()).held.map((lock) => lock.name);
  const running = names.filter((name) => name.startsWith(prefix)).map((name) => name.slice(prefix.length));
  return { own, running };
}

/** Keeps the page for when there is no network. A version that came with the last visit is taken now. */
async function keepForOffline() {
  const workers = navigator.serviceWorker;
  if (!workers) {
    return;
  }
  const known = await workers.getRegistration().catch(() => undefined);
  if (known?.waiting) {
    const taken = new Promise((resolve) => {
      workers.addEventListener("controllerchange", () => resolve(true), { once: true });
      setTimeout(() => resolve(false), 1000);
    });
    known.waiting.postMessage("take over");
    if (await taken) {
      location.reload();
      await new Promise(() => {});
    }
  }
  // Not awaited: the editor does not wait for it, and works without.
  workers.register("sw.js").catch((error) => console.warn(`no use without a network: ${error}`));
}

/** Keys that browsers would take for themselves: to search, to help, and to zoom once more. */
function keepKeys() {
  const withCommand = new Set(["k", "e", "+", "-", "=", "0", "."]);
  const plain = new Set(["F1", "F2"]);
  const take = (event) => {
    const isCommand = (event.ctrlKey || event.metaKey) && !event.altKey;
    if (isCommand ? withCommand.has(event.key.toLowerCase()) : plain.has(event.key)) {
      event.preventDefault();
    }
  };
  window.addEventListener("keydown", take, { capture: true });
}

async function main() {
  part("reload").addEventListener("click", () => location.reload());
  watchForFaults();
  keepKeys();
  if (location.protocol === "file:") {
    say("Sheetwright can't start", "Browsers load programs from web servers only. Put this folder on one and open its address.");
    return;
  }
  if (typeof WebAssembly !== "object" || typeof TransformStream !== "function") {
    say("This browser is too old", "Sheetwright needs a browser of the last three years.");
    return;
  }
  if (!(await hasGraphics())) {
    say(
      "There are no graphics",
      "Sheetwright draws with WebGPU or WebGL 2, and this browser gives neither. Turn on hardware acceleration in its settings, or take another browser.",
    );
    return;
  }
  await keepForOffline();
  try {
    const { default: init, start } = await import("./sheetwright.js");
    await init({ module_or_path: fetched() });
    const { openKept } = await import("./kept.js");
    // Without it the editor works, and says that it keeps nothing.
    const kept = await openKept().catch(() => undefined);
    // Asked after that, so that no tab is taken for dead that has begun meanwhile.
    const { own, running } = await slots();
    const left = [...(kept?.saved ?? [])].filter(([slot]) => slot !== own && !running.includes(slot));
    await start("canvas", own, left.map(([slot]) => slot), left.map(([, bytes]) => bytes), kept?.keep);
  } catch (error) {
    if (!document.documentElement.dataset.fault) {
      const text = "The program could not be loaded or started. Check the network and load the page again.";
      say("Sheetwright can't start", text, String(error));
    }
    return;
  }
  part("notice").hidden = true;
  part("canvas").focus();
}

main();
