// What is not saved outlasts a crash of its tab and the end of the whole browser, and where the
// browser's storage is full, people are told.
//
//   NODE_PATH=…/node_modules node .ci/browser/kept.mjs FOLDER
//
// FOLDER is what `cargo xtask web` has built.
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { all, check, drawOutline, folders, keeping, lift, press, ready, serve, settled, the } from "./page.mjs";

const { folder } = folders(false);
const server = await serve(folder);
const origin = `http://127.0.0.1:${server.address().port}/`;
const kept = mkdtempSync(join(tmpdir(), "sheetwright-kept-"));
/** What may be lost, in ms. */
const MOST_LOST = 2000;

/** The names of all handles in space, with how far they are lifted. */
const handles = async (page) =>
  (await all(page, "button", /, point \d+, (on the plan|lifted )/)).map((handle) => handle.name);

/** Ends every process of the browser that has this folder, at once. */
function kill() {
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      if (readFileSync(`/proc/${id}/cmdline`, "latin1").includes(`--user-data-dir=${kept}`)) {
        process.kill(Number(id), "SIGKILL");
      }
    } catch {
      // It has ended meanwhile.
    }
  }
}

async function open(context) {
  const page = await context.newPage();
  await page.goto(origin);
  await ready(page);
  return page;
}

let context = await keeping(kept);
try {
  let page = await open(context);
  await drawOutline(page);
  await settled(page);
  await lift(page, 1, 60);
  await page.waitForTimeout(MOST_LOST);
  let wanted = await handles(page);
  check(wanted.some((name) => / lifted /.test(name)), `a sheet is drawn: ${wanted}`);
  const crashing = await context.newCDPSession(page);
  const crashed = page.waitForEvent("crash");
  crashing.send("Page.crash").catch(() => {});
  await crashed;

  page = await open(context);
  await press(page, "link", /^untitled, /);
  await the(page, "img", /^Plan/);
  await settled(page);
  check(`${await handles(page)}` === `${wanted}`, "what a crash of the tab left comes back");

  await lift(page, 2, 50);
  await page.waitForTimeout(MOST_LOST);
  wanted = await handles(page);
  kill();
  await context.close().catch(() => {});
  context = await keeping(kept);
  page = await open(context);
  await press(page, "link", /^untitled, /);
  await the(page, "img", /^Plan/);
  await settled(page);
  const found = await handles(page);
  check(`${found}` === `${wanted}`, `what was there ${MOST_LOST} ms before the browser was killed comes back: ${found}`);

  // A browser that has kept something a moment ago believes for half a minute that it can keep more.
  await context.close();
  context = await keeping(kept);
  const limiting = await context.newCDPSession(await open(context));
  await limiting.send("Storage.overrideQuotaForOrigin", { origin: origin.slice(0, -1), quotaSize: 1000 });
  page = await open(context);
  await drawOutline(page);
  const told = await the(page, "status", /Work is not kept by itself: there is no room/);
  check(told.name.includes("Save your work"), `people are told that there is no room: ${told.name}`);
} catch (error) {
  console.error(String(error));
  process.exitCode = 1;
} finally {
  await context.close().catch(() => {});
  server.close();
  rmSync(kept, { recursive: true, force: true });
}
