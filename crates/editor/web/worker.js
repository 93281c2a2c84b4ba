// What computes beside the page: the same program, which the page has compiled and sends first.
import init, { worker_main } from "./sheetwright.js";

self.onmessage = async ({ data }) => {
  self.onmessage = null;
  await init({ module_or_path: data });
  worker_main();
};
