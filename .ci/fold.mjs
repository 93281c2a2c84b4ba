// Reads `pattern.fold` of what `sheetwright make --out DIR --formats fold,report` wrote with npm's
// `fold`, which finds faces and borders of its own.
//
//     NODE_PATH=… node .ci/fold.mjs DIR...
//
// Ends with a line `N passed, N failed`, and with status 1 if anything failed or nothing was read.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const FOLD = createRequire(import.meta.url)("fold");
let passed = 0;
let failed = 0;

function that(what, holds, found) {
  if (holds) {
    passed += 1;
  } else {
    failed += 1;
    console.log(`FAILED ${what}: ${JSON.stringify(found)}`);
  }
}

/** A face from its least vertex on, so that two of one cycle are one text. */
const cycle = (face) => {
  const first = face.indexOf(Math.min(...face));
  return [...face.slice(first), ...face.slice(0, first)].join(" ");
};
const side = ([a, b]) => `${Math.min(a, b)} ${Math.max(a, b)}`;

function checkFrame(name, frame, panel) {
  const { vertices_coords: at, edges_vertices, edges_assignment, edges_foldAngle } = frame;
  const count = edges_vertices.length;
  that(`${name}: a mark and an angle a side`,
    edges_assignment.length === count && edges_foldAngle.length === count, count);
  const sign = { B: 0, F: 0, M: -1, V: 1 };
  that(`${name}: angles have the sign of their marks`,
    edges_assignment.every((mark, n) => Math.sign(edges_foldAngle[n]) === sign[mark]));

  // The borders of its faces, by the library.
  const faces = { faces_vertices: frame.faces_vertices };
  FOLD.convert.faces_vertices_to_edges(faces);
  const borders = (fold) =>
    fold.edges_vertices.filter((_, n) => fold.edges_assignment[n] === "B").map(side).sort();
  that(`${name}: sides`,
    faces.edges_vertices.map(side).sort().join() === edges_vertices.map(side).sort().join());
  that(`${name}: borders`, borders(faces).join() === borders(frame).join());

  // The faces of its sides in the plane, by the library.
  const plane = { vertices_coords: at, edges_vertices };
  FOLD.convert.edges_vertices_to_faces_vertices(plane);
  const known = new Set(plane.faces_vertices.map(cycle));
  const lost = frame.faces_vertices.filter((face) => !known.has(cycle(face)));
  that(`${name}: faces run counter-clockwise in the plane`, lost.length === 0, lost.slice(0, 3));

  const area = frame.faces_vertices
    .map(([a, b, c]) => [at[a], at[b], at[c]])
    .reduce((sum, [a, b, c]) =>
      sum + 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])), 0);
  const told = panel.area_flat_mm2;
  that(`${name}: area`, Math.abs(area - told) <= 1e-6 * told, [area, told]);
}

for (const folder of process.argv.slice(2)) {
  const read = (name) => JSON.parse(readFileSync(join(folder, name), "utf8"));
  const file = read("pattern.fold");
  const { panels } = read("report.json");
  const frames = [file, ...(file.file_frames ?? [])];
  that(`${folder}: a frame a part`, frames.length === panels.length, frames.length);
  frames.forEach((frame, n) => {
    that(`${folder}: names`, frame.frame_title === panels[n].name, frame.frame_title);
    // Faces that lie over one another have no plane graph.
    if (!panels[n].overlaps) checkFrame(`${folder} ${frame.frame_title}`, frame, panels[n]);
  });
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed || !passed ? 1 : 0);
