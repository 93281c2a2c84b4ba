// The editor in a browser, as a person has it: what is there by its name, pressed and dragged with the
// mouse. Nothing here knows where anything is in the canvas: places are those of the page's copies for
// screen readers. Wants playwright-core and a Chromium (CHROMIUM names it, else /usr/bin/chromium).
import { createReadStream, existsSync, mkdirSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join, normalize } from "node:path";

const { chromium } = createRequire(import.meta.url)("playwright-core");

/** The folder of the page, and that of pictures where they are taken, as the command line names them. */
export function folders(takesPictures) {
  const [folder, pictures] = process.argv.slice(2);
  if (!folder || (takesPictures && !pictures)) {
    console.error(`give the folder of the page${takesPictures ? ", and one for pictures" : ""}`);
    process.exit(2);
  }
  if (takesPictures) {
    mkdirSync(pictures, { recursive: true });
  }
  return { folder, pictures };
}

/** How the browser is started: drawing by its own rasteriser, and alone. */
const OPTIONS = {
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--no-sandbox",
    "--disable-background-networking",
  ],
};
const VIEW = { viewport: { width: 1280, height: 800 }, acceptDownloads: true };

/** A browser that keeps nothing when it ends. */
export async function fresh() {
  const browser = await chromium.launch(OPTIONS);
  const context = await browser.newContext(VIEW);
  return { browser, context };
}

/** A browser that keeps what pages store in this folder. */
export function keeping(folder) {
  return chromium.launchPersistentContext(folder, { ...OPTIONS, ...VIEW });
}

const TYPES = {
  css: "text/css",
  html: "text/html",
  js: "text/javascript",
  svg: "image/svg+xml",
  wasm: "application/wasm",
  webmanifest: "application/manifest+json",
};

/** A server of the folder that knows nothing but files. */
export function serve(folder) {
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

export function check(holds, what) {
  if (!holds) {
    throw new Error(what);
  }
  console.log(`ok: ${what}`);
}

/** Waits until the editor has drawn a frame. */
export async function ready(page) {
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
export async function all(page, role, name) {
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
export async function the(page, role, name, timeout = 20_000) {
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

/** Its middle. */
export const middle = ({ x, y, width, height }) => [x + width / 2, y + height / 2];

/** Waits until the page is not busy with frames: what is pressed for longer than a click is none. */
function calm(page) {
  return page.evaluate(
    () =>
      new Promise((done) => {
        const [quick, enough] = [100, 10];
        let count = 0;
        let last = performance.now();
        const look = (now) => {
          count = now - last < quick ? count + 1 : 0;
          last = now;
          if (count < enough) {
            requestAnimationFrame(look);
          } else {
            done();
          }
        };
        requestAnimationFrame(look);
      }),
  );
}

/** The first of them, once it stays where it is: windows move while they open and when they grow. */
async function resting(page, role, name) {
  const end = Date.now() + 30_000;
  while (Date.now() < end) {
    const before = await the(page, role, name);
    await page.waitForTimeout(400);
    await calm(page);
    const after = await the(page, role, name);
    if (`${middle(before)}` === `${middle(after)}`) {
      return after;
    }
  }
  throw new Error(`${role} ${name} does not come to rest`);
}

/** Presses it, once it rests, for as long as a finger does. */
export async function press(page, role, name) {
  await pressAt(page, await resting(page, role, name));
}

/** Presses what lies there, whatever else is going on. */
export async function pressAt(page, thing) {
  await page.mouse.move(...middle(thing));
  await page.waitForTimeout(150);
  await page.mouse.down();
  await page.waitForTimeout(80);
  await page.mouse.up();
}

/** Moves with the button held down, through all places. */
export async function drag(page, places) {
  const [first, ...others] = places;
  await page.mouse.move(...first);
  await page.mouse.down();
  for (const place of others) {
    await page.mouse.move(...place);
  }
  await page.mouse.up();
}

/** Waits until nothing is at work any more. */
export async function settled(page) {
  await page.waitForTimeout(600);
  const end = Date.now() + 60_000;
  while ((await all(page, "button", /^Stop$/)).length > 0) {
    if (Date.now() > end) {
      throw new Error("the editor works for more than a minute");
    }
    await page.waitForTimeout(100);
  }
}

/** Draws an outline round the middle of the plan, from the start page. */
export async function drawOutline(page) {
  await press(page, "button", /^Draw an outline$/);
  const plan = await the(page, "img", /^Plan/);
  const [x, y] = middle(plan);
  const round = [...Array(37).keys()].map((n) => {
    const angle = (n / 36) * 2 * Math.PI;
    return [x + 0.33 * plan.width * Math.cos(angle), y - 0.25 * plan.width * Math.sin(angle)];
  });
  await drag(page, round);
  await the(page, "button", /, point 1, at /);
}

/** Lifts a handle in space by so many pixels. */
export async function lift(page, point, pixels) {
  const handle = await the(page, "button", new RegExp(`, point ${point}, (on the plan|lifted .*)$`));
  const [x, y] = middle(handle);
  await drag(page, [...Array(13).keys()].map((n) => [x, y - (pixels / 12) * n]));
}

/** The share of all values that is at most this. */
export function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor((sorted.length - 1) * share)];
}
