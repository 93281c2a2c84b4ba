// Drives the editor in a browser, as a person would: draws an outline with the mouse, lifts a point of
// it, and downloads the pattern; then loads the page again without a network.
//
//   NODE_PATH=…/node_modules node .ci/browser/draw.mjs FOLDER PICTURES
//
// FOLDER is what `cargo xtask web` has built, PICTURES gets screenshots and the download.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { all, check, drawOutline, folders, fresh, lift, press, ready, serve, settled, the } from "./page.mjs";

const { folder, pictures } = folders(true);
const server = await serve(folder);
const origin = `http://127.0.0.1:${server.address().port}`;
const { browser, context } = await fresh();
const page = await context.newPage();
const errors = [];
const strangers = [];
page.on("pageerror", (error) => errors.push(String(error)));
page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
page.on("request", (request) => {
  const url = request.url();
  if (!url.startsWith(origin) && !url.startsWith("blob:") && !url.startsWith("data:")) {
    strangers.push(url);
  }
});
const shoot = (name) => page.screenshot({ path: join(pictures, `${name}.png`) });

try {
  const start = Date.now();
  await page.goto(`${origin}/`);
  await ready(page);
  console.log(`ready after ${Date.now() - start} ms`);
  await shoot("start");

  const begun = Date.now();
  await drawOutline(page);
  console.log(`outline after ${Date.now() - begun} ms, with the time of the hand`);
  await settled(page);
  await shoot("outline");

  const flat = await the(page, "button", /, point 1, on the plan$/);
  await lift(page, 1, 72);
  const lifted = await the(page, "button", /, point 1, lifted /);
  check(lifted.y < flat.y - 40, `the handle follows the hand: ${lifted.name}`);
  const [before] = await all(page, "button", /, point 1, at /);
  check(before !== undefined, "the plan stays");
  await settled(page);
  await shoot("lifted");

  await press(page, "button", /^Export/);
  await the(page, "button", /^Download$/);
  await page.waitForTimeout(300);
  await shoot("export");
  const [download] = await Promise.all([page.waitForEvent("download"), press(page, "button", /^Download$/)]);
  const archive = join(pictures, download.suggestedFilename());
  await download.saveAs(archive);
  const bytes = readFileSync(archive);
  check(bytes.subarray(0, 2).toString() === "PK" && bytes.length > 10_000, `${archive} is an archive of ${bytes.length} bytes`);
  for (const ending of [".svg", ".dxf", "surface.obj", "pattern.pdf", "report.html"]) {
    check(bytes.includes(ending), `it has a ${ending}`);
  }
  await page.waitForTimeout(500);
  await shoot("exported");

  // Without the server everything is there all the same.
  await page.evaluate(() => navigator.serviceWorker.ready.then(() => true));
  const asked = page.waitForEvent("dialog");
  const reloaded = page.reload();
  const question = await asked;
  check(question.type() === "beforeunload", "the browser asks before it leaves work that no file has");
  await question.accept();
  await reloaded;
  await ready(page);
  server.closeAllConnections();
  await new Promise((closed) => server.close(closed));
  const offline = Date.now();
  await page.reload();
  await ready(page);
  console.log(`ready without a network after ${Date.now() - offline} ms`);
  await shoot("offline");

  check(strangers.length === 0, `nothing is asked of other servers (${strangers})`);
  check(errors.length === 0, `no errors (${errors.join("; ")})`);
} catch (error) {
  await shoot("failed").catch(() => {});
  console.error(String(error), errors.join("\n"));
  process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
