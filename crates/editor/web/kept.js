// Keeps the work of tabs in the browser's database, where it outlasts the tab and the browser.

const DATABASE = "sheetwright";
const SAVED = "saved";

/** What a request comes to. */
function answer(request) {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** When a transaction is on the disk. */
function done(transaction) {
  return new Promise((resolve, reject) => {
    transaction.oncomplete = () => resolve();
    transaction.onerror = transaction.onabort = () => reject(transaction.error);
  });
}

/** Whether the database holds just these bytes: the browser compares them. */
function sameBytes(found, bytes) {
  return found !== undefined && indexedDB.cmp(found, bytes) === 0;
}

/** Why bytes could not be kept, in words. */
async function inWords(error, bytes) {
  if (error?.name !== "QuotaExceededError") {
    return new Error(`the browser does not keep it (${error?.message ?? error})`);
  }
  const mb = (count) => (count / 1e6).toFixed(1);
  const { quota, usage } = (await navigator.storage?.estimate?.()) ?? {};
  const left = quota === undefined ? "" : `, and ${mb(Math.max(0, quota - usage))} MB are left`;
  return new Error(`there is no room in the browser's storage: this takes ${mb(bytes.length)} MB${left}`);
}

/** Keeps bytes in a slot, or empties it. */
async function keep(database, slot, bytes) {
  const begin = (mode) => database.transaction(SAVED, mode, { durability: "strict" });
  const writing = begin("readwrite");
  const store = writing.objectStore(SAVED);
  const written = done(writing);
  if (bytes === undefined) {
    store.delete(slot);
    writing.commit();
    return written;
  }
  store.put(bytes, slot);
  writing.commit();
  // Begun now, so that it reads this and nothing that is written later.
  const read = answer(begin("readonly").objectStore(SAVED).get(slot));
  const [end, back] = await Promise.allSettled([written, read]);
  if (end.status === "rejected") {
    throw await inWords(end.reason, bytes);
  }
  if (!sameBytes(back.value, bytes)) {
    throw new Error("the browser did not keep what was written");
  }
}

/** All that the database holds. */
async function all(database) {
  const store = database.transaction(SAVED, "readonly").objectStore(SAVED);
  const [slots, contents] = await Promise.all([answer(store.getAllKeys()), answer(store.getAll())]);
  return new Map(slots.map((slot, n) => [slot, contents[n]]));
}

/** Opens the database: what it holds, and a way to keep more. Throws where there is none. */
export async function openKept() {
  const asked = indexedDB.open(DATABASE, 1);
  asked.onupgradeneeded = () => asked.result.createObjectStore(SAVED);
  const database = await answer(asked);
  return { saved: await all(database), keep: (slot, bytes) => keep(database, slot, bytes) };
}
