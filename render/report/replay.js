"use strict";
// Draws a frame: coloured triangles by WebGL, or by paths where there is none; over them outlines, arrow, spoke, scales.
const viridis = ("440154 481a6c 472f7d 414487 39568c 31688e 2a788e 23888e 1f988b 22a884 35b779 54c568 7ad151 a5db36 " +
  "d2e21b fde725").split(" ").map(hex => [0, 2, 4].map(i => parseInt(hex.slice(i, i + 2), 16)));

function viridisAt(share) {
  const t = Math.max(0, Math.min(1, share)) * 15, i = Math.min(14, Math.floor(t)), u = t - i;
  return [0, 1, 2].map(j => Math.round(viridis[i][j] * (1 - u) + viridis[i + 1][j] * u));
}
const bins = 64;
const shades = Array.from({ length: bins }, (_, k) => `rgb(${viridisAt(k / (bins - 1)).join()})`);

// A painter of triangles on a canvas: paint(width, height, screen places, shares 0..1, triangles); null without WebGL.
function makeGlPainter(canvas) {
  if (/\bnogl\b/.test(location.hash)) return null;
  const gl = canvas.getContext("webgl", { antialias: true, alpha: false, preserveDrawingBuffer: true });
  if (!gl || !gl.getExtension("OES_element_index_uint")) return null;
  const program = gl.createProgram();
  const add = (type, source) => {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  };
  add(gl.VERTEX_SHADER, `attribute vec2 place; attribute float share; uniform vec2 size; varying float value;
    void main() { value = share; gl_Position = vec4(place.x / size.x * 2. - 1., 1. - place.y / size.y * 2., 0., 1.); }`);
  add(gl.FRAGMENT_SHADER, `precision mediump float; varying float value; uniform sampler2D map;
    void main() { gl_FragColor = texture2D(map, vec2(clamp(value, .002, .998), .5)); }`);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  gl.useProgram(program);
  const map = new Uint8Array(4 * 256);
  for (let k = 0; k < 256; k++) map.set([...viridisAt(k / 255), 255], 4 * k);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, map);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
  const placeAt = gl.getAttribLocation(program, "place"), shareAt = gl.getAttribLocation(program, "share");
  const size = gl.getUniformLocation(program, "size");
  const placeBuffer = gl.createBuffer(), shareBuffer = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.enableVertexAttribArray(placeAt);
  gl.enableVertexAttribArray(shareAt);
  let mesh = null;
  const send = (buffer, values, attribute, width) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    gl.vertexAttribPointer(attribute, width, gl.FLOAT, false, 0, 0);
  };
  return (width, height, places, shares, triangles) => {
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.uniform2f(size, width, height);
    gl.clearColor(244 / 255, 246 / 255, 248 / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (mesh !== triangles) gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh = triangles, gl.STATIC_DRAW);
    send(placeBuffer, places, placeAt, 2);
    send(shareBuffer, shares, shareAt, 1);
    gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_INT, 0);
  };
}

// The same by one path a colour.
function paintPaths(context, places, shares, triangles) {
  const paths = Array.from({ length: bins }, () => null);
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [triangles[i], triangles[i + 1], triangles[i + 2]];
    const bin = Math.max(0, Math.min(bins - 1, Math.round((shares[a] + shares[b] + shares[c]) / 3 * (bins - 1))));
    const path = paths[bin] || (paths[bin] = new Path2D());
    path.moveTo(places[2 * a], places[2 * a + 1]);
    path.lineTo(places[2 * b], places[2 * b + 1]);
    path.lineTo(places[2 * c], places[2 * c + 1]);
    path.closePath();
  }
  context.lineWidth = 0.7;
  paths.forEach((path, bin) => {
    if (!path) return;
    context.fillStyle = context.strokeStyle = shades[bin];
    context.fill(path);
    context.stroke(path);
  });
}

// What a viewer of this impact sees: a window about the whole flight of the projectile. [R]
function windowOf(replay, frames) {
  const body = replay.bodies[0], low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (let f = 0; f < replay.frames; f++) {
    for (let n = body.first; n < body.first + body.nodes; n++) {
      for (let k = 0; k < 2; k++) {
        const x = frames.place[(f * replay.nodes + n) * 2 + k] * replay.grid;
        low[k] = Math.min(low[k], x);
        high[k] = Math.max(high[k], x);
      }
    }
  }
  const size = Math.max(high[0] - low[0], high[1] - low[1]);
  const below = replay.bodies.some((other, i) => i > 0 && other.nodes > 2) ? 0.9 * Math.min(size, 3) : 0.15 * size;
  const width = Math.max(high[0] - low[0] + 0.5 * size, 1.75 * (high[1] - low[1] + below + 0.15 * size));
  const middle = (high[0] + low[0]) / 2;
  return { left: middle - width / 2, width, top: high[1] + 0.15 * size };
}

// Places of a moment between frames, in R; the strain of the body about its mean motion magnified. [node][xy]
function placesAt(replay, frames, at, magnify) {
  const f = Math.min(replay.frames - 2, Math.floor(at)), u = at - f, N = replay.nodes;
  const places = new Float32Array(2 * N);
  const a = f * N * 2, b = a + N * 2;
  for (let k = 0; k < 2 * N; k++) {
    places[k] = (frames.place[a + k] * (1 - u) + frames.place[b + k] * u) * replay.grid;
  }
  if (magnify !== 1) for (const body of replay.bodies) stretch(replay, frames, body, places, magnify);
  return places;
}

// The rigid motion from the first frame that fits a body best: centres before and now, and the turn.
function motionOf(replay, frames, body, places) {
  let x = 0, y = 0, x0 = 0, y0 = 0, sine = 0, cosine = 0;
  const end = body.first + body.nodes, g = replay.grid, first = frames.place;
  for (let n = body.first; n < end; n++) {
    x0 += first[2 * n] * g / body.nodes;
    y0 += first[2 * n + 1] * g / body.nodes;
    x += places[2 * n] / body.nodes;
    y += places[2 * n + 1] / body.nodes;
  }
  for (let n = body.first; n < end; n++) {
    const a = first[2 * n] * g - x0, b = first[2 * n + 1] * g - y0, c = places[2 * n] - x, d = places[2 * n + 1] - y;
    sine += a * d - b * c;
    cosine += a * c + b * d;
  }
  const size = Math.hypot(sine, cosine) || 1;
  return { x0, y0, x, y, sine: sine / size, cosine: cosine / size };
}

function rigidPlace(replay, frames, motion, n) {
  const a = frames.place[2 * n] * replay.grid - motion.x0, b = frames.place[2 * n + 1] * replay.grid - motion.y0;
  return [motion.x + motion.cosine * a - motion.sine * b, motion.y + motion.sine * a + motion.cosine * b];
}

function stretch(replay, frames, body, places, factor) {
  if (body.nodes < 3) return;
  const motion = motionOf(replay, frames, body, places);
  for (let n = body.first; n < body.first + body.nodes; n++) {
    const [x, y] = rigidPlace(replay, frames, motion, n);
    places[2 * n] = x + factor * (places[2 * n] - x);
    places[2 * n + 1] = y + factor * (places[2 * n + 1] - y);
  }
}

// How far along the colours every node is, 0 to 1.
function sharesAt(replay, frames, at, field, places) {
  const N = replay.nodes, shares = new Float32Array(N);
  if (field === "shift") {
    for (const body of replay.bodies) {
      const motion = motionOf(replay, frames, body, places);
      for (let n = body.first; n < body.first + body.nodes; n++) {
        const [x, y] = rigidPlace(replay, frames, motion, n);
        shares[n] = Math.sqrt(Math.hypot(places[2 * n] - x, places[2 * n + 1] - y) / shiftTop(replay, frames));
      }
    }
    return shares;
  }
  const f = Math.min(replay.frames - 2, Math.floor(at)), u = at - f, a = f * N, b = a + N;
  for (let n = 0; n < N; n++) {
    shares[n] = (frames.colour[a + n] * (1 - u) + frames.colour[b + n] * u) / replay.levels;
  }
  return shares;
}

// The largest displacement of a body within itself over some of the frames. [R]
function shiftTop(replay, frames) {
  if (frames.shiftTop) return frames.shiftTop;
  let top = 1e-3;
  for (let f = 0; f < replay.frames - 1; f += Math.max(1, Math.floor(replay.frames / 24))) {
    const places = placesAt(replay, frames, f, 1);
    for (const body of replay.bodies) {
      if (body.nodes < 3) continue;
      const motion = motionOf(replay, frames, body, places);
      for (let n = body.first; n < body.first + body.nodes; n++) {
        const [x, y] = rigidPlace(replay, frames, motion, n);
        top = Math.max(top, Math.hypot(places[2 * n] - x, places[2 * n + 1] - y));
      }
    }
  }
  return frames.shiftTop = top;
}

// Draws the moment `at` (in frames) onto a canvas; `paint`: a WebGL painter of the canvas below, or null.
function drawMoment(canvas, paint, replay, frames, at, { magnify = 1, field = "speed", scales = true } = {}) {
  const context = canvas.getContext("2d"), { width, height } = canvas;
  const view = frames.window || (frames.window = windowOf(replay, frames));
  const scale = width / view.width;
  const onX = x => (x - view.left) * scale, onY = y => (view.top - y) * scale;
  const real = placesAt(replay, frames, at, 1);
  const shares = sharesAt(replay, frames, at, field, real);
  const places = magnify === 1 ? real : placesAt(replay, frames, at, magnify);
  const screen = new Float32Array(places.length);
  for (let n = 0; n < replay.nodes; n++) {
    screen[2 * n] = onX(places[2 * n]);
    screen[2 * n + 1] = onY(places[2 * n + 1]);
  }
  context.clearRect(0, 0, width, height);
  if (paint) {
    paint(width, height, screen, shares, frames.triangles);
  } else {
    context.fillStyle = "#f4f6f8";
    context.fillRect(0, 0, width, height);
    paintPaths(context, screen, shares, frames.triangles);
  }
  drawRims(context, replay, screen, width / 960);
  if (scales) drawScales(context, replay, frames, at, scale, onX, onY);
}

function drawRims(context, replay, screen, thick) {
  context.strokeStyle = "#1c2430";
  context.lineWidth = Math.max(0.8, 1.6 * thick);
  for (const body of replay.bodies) {
    for (const chain of body.chains) {
      context.beginPath();
      chain.node.forEach((n, i) => context[i ? "lineTo" : "moveTo"](screen[2 * n], screen[2 * n + 1]));
      if (chain.closed) context.closePath();
      context.stroke();
    }
  }
}

function arrow(context, x, y, dx, dy, colour) {
  const length = Math.hypot(dx, dy);
  if (length < 6) return;
  const head = Math.min(16, 0.4 * length), angle = Math.atan2(dy, dx);
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 3;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + dx, y + dy);
  context.stroke();
  context.beginPath();
  context.moveTo(x + dx, y + dy);
  for (const turn of [2.7, -2.7]) context.lineTo(x + dx + head * Math.cos(angle + turn), y + dy + head * Math.sin(angle + turn));
  context.fill();
}

function drawScales(context, replay, frames, at, scale, onX, onY) {
  const { width, height } = context.canvas, series = replay.series;
  const big = Math.max(width / 960, 0.8 * width / (context.canvas.clientWidth || width));  // legible on a phone
  const k = Math.min(replay.frames - 1, Math.round(at)), body = replay.bodies[0];
  const motion = motionOf(replay, frames, body, placesAt(replay, frames, at, 1));
  const fastest = Math.max(...series.vn.map((v, i) => Math.hypot(v, series.vt[i]))) || 1;
  const radius = bodyRadius(replay, frames), x = onX(series.x[k] / replay.length), y = onY(series.height[k] / replay.length);
  context.strokeStyle = "#fff";
  context.lineWidth = 2.5;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + radius * scale * motion.cosine, y - radius * scale * motion.sine);
  context.stroke();
  const long = 1.1 * radius * scale / fastest;
  arrow(context, x, y, series.vt[k] * long, -series.vn[k] * long, "#e6194b");
  context.font = `${Math.round(15 * big)}px system-ui, "DejaVu Sans", sans-serif`;
  lengthBar(context, replay, scale, big, height);
}

// From the projectile's centre of mass to the nearest of its surface, in the first frame. [R]
function bodyRadius(replay, frames) {
  const body = replay.bodies[0], x0 = replay.series.x[0] / replay.length, y0 = replay.series.height[0] / replay.length;
  let least = Infinity;
  for (const chain of body.chains) {
    for (const n of chain.node) {
      least = Math.min(least, Math.hypot(frames.place[2 * n] * replay.grid - x0, frames.place[2 * n + 1] * replay.grid - y0));
    }
  }
  return Number.isFinite(least) ? least : 0.1 * frames.window.width;
}

// The scale of colours, below the picture. Both fields are coloured by the root of their share of the greatest value.
function showColours(replay, frames, field) {
  const top = field === "shift" ? shiftTop(replay, frames) * replay.length : replay.top;
  const unit = field === "shift" ? replay.lengthUnit : replay.speedUnit;
  const strip = element("span", { className: "strip-of-colours" });
  strip.style.background = `linear-gradient(to right, ${shades.filter((_, k) => k % 7 === 0).join()})`;
  const marks = [0, 0.25, 1].map(share => {
    const mark = element("span", {}, share === 0 ? "0" : (share === 1 ? "≥ " : "") + shown(share * top, 2));
    mark.style.left = `${100 * Math.sqrt(share)}%`;
    return mark;
  });
  byId("colours").replaceChildren(element("span", {}, withUnit(field === "shift" ? "displacement within the body" : "speed", unit)),
    element("span", { className: "bar-of-colours" }, strip, ...marks));
}

function lengthBar(context, replay, scale, big, height) {
  const most = 200 * big / scale * replay.length, power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map(k => k * power).find(x => x <= most);
  const long = length / replay.length * scale, y = height - 18 * big, text = `${shown(length)} ${replay.lengthUnit}`;
  context.fillStyle = "rgba(255,255,255,.85)";
  context.fillRect(12 * big, y - 16 * big, long + 30 * big + context.measureText(text).width, 28 * big);
  context.fillStyle = "#1c2430";
  context.fillRect(20 * big, y - 2, long, 4);
  context.textAlign = "left";
  context.fillText(text, 28 * big + long, y + 5 * big);
}
