"use strict";
// What the page carries, as numbers: base64, deflate, byte planes, differences.
const byId = id => document.getElementById(id);
const pageData = JSON.parse(byId("data").textContent);

async function inflate(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

// The numbers of a column: written out, one for all rows, or binary.
async function columnValues(column, rows) {
  if (column.values) return column.values;
  if ("same" in column) return new Array(rows).fill(column.same);
  const single = "float32" in column;
  const bytes = await inflate(single ? column.float32 : column.float64);
  const numbers = Array.from(single ? new Float32Array(bytes) : new Float64Array(bytes));
  return numbers.map(x => Number.isFinite(x) ? x : null);
}

// A section's columns by name, each with unit, doc, whether the sweep asked for it, and its values.
async function readColumns(section) {
  const columns = {};
  for (const column of section.columns) {
    const parameter = column.doc === "parameter of the sweep";
    columns[column.name] = { name: column.name, unit: column.unit, doc: column.doc, parameter,
      values: await columnValues(column, section.rows) };
  }
  return columns;
}

// Every frame's places in units of the grid, [frame][node][xy]; levels of colour, [frame][node]; triangles.
async function readReplay(replay) {
  const { frames, nodes } = replay;
  const planes = new Uint8Array(await inflate(replay.place));
  const levels = new Uint8Array(await inflate(replay.colour));
  const place = new Int16Array(frames * nodes * 2), colour = new Uint8Array(frames * nodes);
  const half = planes.length / 2;
  for (let k = 0; k < 2 * nodes; k++) {
    for (let f = 0, sum = 0, at = k * frames; f < frames; f++, at++) {
      sum = (sum + (planes[at] | planes[half + at] << 8)) << 16 >> 16;
      place[f * nodes * 2 + k] = sum;
    }
  }
  for (let n = 0; n < nodes; n++) {
    for (let f = 0, sum = 0; f < frames; f++) {
      sum = (sum + levels[n * frames + f]) & 255;
      colour[f * nodes + n] = sum;
    }
  }
  const steps = new Uint8Array(await inflate(replay.triangles)), count = steps.length / 4;
  const triangles = new Uint32Array(count);
  for (let i = 0, sum = 0; i < count; i++) {
    sum = (sum + (steps[i] | steps[count + i] << 8 | steps[2 * count + i] << 16 | steps[3 * count + i] << 24)) >>> 0;
    triangles[i] = sum;
  }
  return { place, colour, triangles };
}
