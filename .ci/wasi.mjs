// Runs a command that is compiled for WebAssembly with WASI: node .ci/wasi.mjs PROGRAM ARGUMENT...
// Its status is that of the command. WASI knows no current folder: relative paths lie below `/`, so
// that is the current folder here, and what absolute arguments begin with is opened beside it.
import { readFile } from 'node:fs/promises';
import { WASI } from 'node:wasi';

const [program, ...args] = process.argv.slice(2);
const preopens = { '/': process.cwd() };
for (const arg of args.filter((arg) => arg.startsWith('/'))) {
  const first = `/${arg.split('/')[1]}`;
  preopens[first] = first;
}
const wasi = new WASI({ version: 'preview1', args: ['sheetwright', ...args], preopens });
const module = await WebAssembly.compile(await readFile(program));
// Node's direct calls from WebAssembly keep the memory of before it grew, and end in signals (seen in
// 20.20). Functions in between take the way through JavaScript, which asks for the memory anew.
const { wasi_snapshot_preview1: direct } = wasi.getImportObject();
const indirect = Object.fromEntries(
  Object.entries(direct).map(([name, call]) => [name, (...values) => call(...values)]),
);
const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: indirect });
process.exitCode = wasi.start(instance);
