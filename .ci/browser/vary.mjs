// Opens a sheet that twists, in a browser, and makes it bend: stopped once, then tried to its end,
// looked at before and after, and taken back.
//
//   NODE_PATH=…/node_modules node .ci/browser/vary.mjs FOLDER PICTURES
//
// FOLDER is what `cargo xtask web` has built, PICTURES gets screenshots; to be run where `examples` is.
import { join } from "node:path";
import { all, check, folders, fresh, press, pressAt, ready, serve, settled, the } from "./page.mjs";

const { folder, pictures } = folders(true);
const server = await serve(folder);
const { browser, context } = await fresh();

/** The largest twist of each panel as it is shown, in degrees, once the fine panels follow the coarse. */
async function twists(page) {
  const read = async () => {
    await the(page, "link", /^Largest twist /);
    const links = await all(page, "link", /^Largest twist /);
    return links.map(({ name }) => Number(/^Largest twist ([\d.]+)°/.exec(name)[1]));
  };
  const end = Date.now() + 60_000;
  while (Date.now() < end) {
    const before = await read();
    await page.waitForTimeout(2000);
    const after = await read();
    if (`${before}` === `${after}`) {
      return after;
    }
  }
  throw new Error("the twist that is shown does not come to rest");
}

const page = await context.newPage();
const shoot = (name) => page.screenshot({ path: join(pictures, `${name}.png`) });

try {
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await ready(page);
  // What can't be opened is said, and the page stays.
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), press(page, "button", /^Open/)]);
  await chooser.setFiles("examples/ubc-fishing-vessel.sheet.json");
  await the(page, "status", /ubc-fishing-vessel.csv/);
  // What lies farther down the page can't be pressed.
  await press(page, "textbox", /^Search shapes$/);
  await page.keyboard.type("window");
  await page.waitForTimeout(1000);
  await press(page, "button", /^Window sheet$/);
  await the(page, "img", /^Plan/);
  await settled(page);
  const before = await twists(page);
  await press(page, "button", /^Make it bend/);
  await press(page, "radio", /^As little twist/);
  await press(page, "button", /^Try it$/);
  await pressAt(page, await the(page, "button", /^Stop$/));
  await settled(page);
  check((await all(page, "button", /^Accept$/)).length === 0, "what is stopped moves nothing");
  const stopped = await twists(page);
  check(`${stopped}` === `${before}`, `and what is shown stays: ${before} degrees, ${stopped}`);

  await press(page, "button", /^Try it$/);
  await the(page, "button", /^Accept$/, 120_000);
  await page.waitForTimeout(300);
  await shoot("varied");
  await press(page, "button", /^Accept$/);
  await settled(page);
  const after = await twists(page);
  const [most, left] = [Math.max(...before), Math.max(...after)];
  check(left < most, `it twists less: at most ${most} degrees before, ${left} after`);
  await shoot("accepted");

  await press(page, "button", /^Undo$/);
  await settled(page);
  check(`${await twists(page)}` === `${before}`, "undo takes it back");
} catch (error) {
  await shoot("failed").catch(() => {});
  console.error(String(error));
  process.exitCode = 1;
} finally {
  await browser.close();
  server.close();
}
