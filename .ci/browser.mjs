// Drives the editor in a browser, as a person would: draws an outline with the mouse, lifts a point of
// it, and downloads the pattern; then loads the page again without a network.
//
//   NODE_PATH=…/node_modules node .ci/browser.mjs FOLDER PICTURES
//
// FOLDER is what `cargo xtask web` has built, PICTURES gets screenshots and the download. Wants
// playwright-core and a Chromium (CHROMIUM names it, else /usr/bin/chromium). Nothing here knows where
// anything is in the canvas: places are those of the page's copies for screen readers.
import { createReadStream, existsSync, mkdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join, normalize } from "node:path";

const { chromium } = createRequire(import.meta.url)("playwright-core");
const [folder, pictures] = process.argv.slice(2);
if (!folder || !pictures) {
  console.error("give the folder of the page, and one for pictures");
  process.exit(2);
}
mkdirSync(pictures, { recursive: true });

const TYPES = {
  css: "text/css",
  html: "text/html",
  js: "text/javascript",
  svg: "image/svg+xml",
  wasm: "application/wasm",
  webmanifest: "application/manifest+json",
};

/** A server of the folder that knows nothing but files. */
function serve() {
  const server = createServer((request, response) => {
    const path = new URL(request.url, "http://localhost").pathname;
    const file = join(folder, normalize(path.endsWith("/") ? `${path}index.html` : path));
    if (!existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { "content-type": TYPES[file.split(".").pop()] ?? "application/octet-stream" });
    createReadStream(file).pipe(response);
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

function check(holds, what) {
  if (!holds) {
    throw new Error(what);
  }
  console.log(`ok: ${what}`);
}

/** Waits until the editor has drawn a frame. */
async function ready(page) {
  const state = await page.waitForFunction(
    () => {
      const { ready, failed } = document.documentElement.dataset;
      return failed ? document.getElementById("notice").textContent : ready && "ready";
    },
    null,
    { timeout: 120_000 },
  );
  check((await state.jsonValue()) === "ready", `the editor starts (${await state.jsonValue()})`);
}

/** What is in the canvas under this role and with a name that fits, as boxes with their names. */
async function all(page, role, name) {
  return page.$$eval(
    `#mirror [role="${role}"]`,
    (elements, source) => {
      const name = new RegExp(source);
      return elements
        .filter((element) => name.test(element.getAttribute("aria-label")))
        .filter((element) => element.getBoundingClientRect().left >= 0)
        .map((element) => {
          const { x, y, width, height } = element.getBoundingClientRect();
          const state = element.getAttribute("aria-valuetext") ?? element.getAttribute("aria-pressed");
          const enabled = element.getAttribute("aria-disabled") !== "true";
          return { name: element.getAttribute("aria-label"), state, enabled, x, y, width, height };
        });
    },
    name.source,
  );
}

/** The first of them, as soon as it is there. */
async function the(page, role, name, timeout = 20_000) {
  const end = Date.now() + timeout;
  for (;;) {
    const [found] = await all(page, role, name);
    if (found) {
      return found;
    }
    if (Date.now() > end) {
      const there = (await all(page, role, /./)).map((thing) => thing.name);
      throw new Error(`there is no ${role} ${name}, but ${JSON.stringify(there)}`);
    }
    await page.waitForTimeout(100);
  }
}

const middle = ({ x, y, width, height }) => [x + width / 2, y + height / 2];

/** Presses it for as long as a finger does. */
async function press(page, role, name) {
  await page.mouse.move(...middle(await the(page, role, name)));
  await page.waitForTimeout(150);
  await page.mouse.down();
  await page.waitForTimeout(80);
  await page.mouse.up();
}

/** Moves with the button held down, through all places. */
async function drag(page, places) {
  const [first, ...others] = places;
  await page.mouse.move(...first);
  await page.mouse.down();
  for (const place of others) {
    await page.mouse.move(...place, { steps: 3 });
    await page.waitForTimeout(16);
  }
  await page.mouse.up();
}

/** Waits until nothing is at work any more. */
async function settled(page) {
  await page.waitForTimeout(600);
  const end = Date.now() + 60_000;
  while ((await all(page, "button", /^Stop$/)).length > 0) {
    if (Date.now() > end) {
      throw new Error("the editor works for more than a minute");
    }
    await page.waitForTimeout(100);
  }
}

const server = await serve();
const origin = `http://127.0.0.1:${server.address().port}`;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--no-sandbox",
    "--disable-background-networking",
  ],
});
const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, acceptDownloads: true });
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

  await press(page, "button", /^Draw an outline$/);
  const plan = await the(page, "img", /^Plan/);
  const [x, y] = middle(plan);
  const round = [...Array(73).keys()].map((n) => {
    const angle = (n / 72) * 2 * Math.PI;
    return [x + 0.33 * plan.width * Math.cos(angle), y - 0.25 * plan.width * Math.sin(angle)];
  });
  const begun = Date.now();
  await drag(page, round);
  await the(page, "button", /, point 1, at /);
  console.log(`outline after ${Date.now() - begun} ms, with the time of the hand`);
  await settled(page);
  await shoot("outline");

  const flat = await the(page, "button", /, point 1, on the plan$/);
  const [hx, hy] = middle(flat);
  await drag(page, [...Array(13).keys()].map((n) => [hx, hy - 6 * n]));
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
  await page.reload();
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
