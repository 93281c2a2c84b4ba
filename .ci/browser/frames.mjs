// How long the page is busy for a frame while a handle of a panel of 400 samples is dragged in the
// editor: the time of the page's own thread in every callback of an animation frame. What the graphics
// card does is not in it, so that it means something where a card is imitated.
//
//   NODE_PATH=…/node_modules node .ci/browser/frames.mjs FOLDER
//
// FOLDER is what `cargo xtask web` has built.
import { check, drawOutline, folders, fresh, lift, middle, quantile, ready, serve, settled, the } from "./page.mjs";

const { folder } = folders(false);
/** What a frame may take, in ms. */
const FRAME = 33;
const MOVES = 200;

const server = await serve(folder);
const { browser, context } = await fresh();
try {
  const page = await context.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await ready(page);
  await drawOutline(page);
  await settled(page);
  await lift(page, 1, 60);
  await settled(page);
  await page.evaluate(() => {
    window.frames_ms = [];
    const ask = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (draw) =>
      ask((time) => {
        const begun = performance.now();
        draw(time);
        window.frames_ms.push(performance.now() - begun);
      });
  });
  const [x, y] = middle(await the(page, "button", /, point 1, at /));
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let n = 1; n <= MOVES; n += 1) {
    await page.mouse.move(x + 30 * Math.sin(0.2 * n), y + 12 * Math.sin(0.26 * n));
  }
  await page.mouse.up();
  const frames = await page.evaluate(() => window.frames_ms);
  const said = [0.5, 0.9, 0.99, 1].map((share) => quantile(frames, share).toFixed(1));
  console.log(`${frames.length} frames: median ${said[0]} ms, 90th ${said[1]}, 99th ${said[2]}, longest ${said[3]}`);
  check(frames.length > 50, "frames were drawn");
  // Other programs make some frames long; they do not make half of them so.
  check(quantile(frames, 0.5) < FRAME, `half of the frames take less than ${FRAME} ms`);
} catch (error) {
  console.error(String(error));
  process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
