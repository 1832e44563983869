// Applies a linear polarizer to a Stokes image: I = 1/2 (S0 + S1 cos 2f + S2 sin 2f) for each colour.
// packed_stokes in report_images.py encodes the data.

// Returns the 8-bit display value of radiance times gain, with the tone curve of render/image/output.cpp.
function toneMapped(x) {
  x = Math.min(Math.max(x, 0), 1e6);
  if (x > 0.7) x = 0.7 + 0.3 * (1 - Math.exp(-(x - 0.7) / 0.3));
  const s = x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055;
  return Math.floor(s * 255 + 0.5);
}

// Table of the tone curve over the square root of its argument, up to display white (x = 4).
const toneSteps = 8191, toneTop = 4;
const toneTable = Uint8ClampedArray.from({ length: toneSteps + 1 }, (_, i) => toneMapped(toneTop * (i / toneSteps) ** 2));

async function unpackStokes({ width, height, largest, data }) {
  const packed = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  // Decode the differences along each row.
  for (let row = 0; row < bytes.length; row += width)
    for (let x = row + 1; x < row + width; ++x) bytes[x] += bytes[x - 1];
  const count = width * height, s0 = new Float32Array(3 * count), s1 = new Float32Array(3 * count), s2 = new Float32Array(3 * count);
  for (let c = 0; c < 3; ++c)
    for (let i = 0; i < count; ++i) {
      const at = 3 * i + c, level = (bytes[c * count + i] * 256 + bytes[(3 + c) * count + i]) / 65535;
      s0[at] = largest * level * level;
      s1[at] = (s0[at] * (bytes[(6 + c) * count + i] - 128)) / 127;
      s2[at] = (s0[at] * (bytes[(9 + c) * count + i] - 128)) / 127;
    }
  return { width, height, s0, s1, s2 };
}

function drawFiltered(context, stokes, gain, degrees) {
  const { width, height, s0, s1, s2 } = stokes, image = context.createImageData(width, height), out = image.data;
  const filtered = degrees !== null, turn = filtered ? (2 * degrees * Math.PI) / 180 : 0;
  const half = filtered ? 0.5 : 1, c = filtered ? 0.5 * Math.cos(turn) : 0, s = filtered ? 0.5 * Math.sin(turn) : 0;
  const scale = gain / toneTop;
  for (let i = 0, at = 0; i < out.length; i += 4) {
    for (let k = 0; k < 3; ++k, ++at) {
      const x = (half * s0[at] + c * s1[at] + s * s2[at]) * scale;
      out[i + k] = toneTable[x <= 0 ? 0 : x >= 1 ? toneSteps : (Math.sqrt(x) * toneSteps + 0.5) | 0];
    }
    out[i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

for (const figure of document.querySelectorAll(".filter")) {
  const data = JSON.parse(figure.closest("[data-images]").querySelector('script[type="application/json"]').textContent);
  const turn = figure.querySelector("[data-turn]"), on = figure.querySelector("[data-on]");
  const angle = figure.querySelector("[data-angle]"), context = figure.querySelector("canvas").getContext("2d");
  let stokes = null, waiting = false;
  const draw = () => {
    angle.textContent = `${turn.value}°`;
    if (!stokes || waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      drawFiltered(context, stokes, 2 ** data.exposureEv, on.checked ? Number(turn.value) : null);
    });
  };
  turn.addEventListener("input", draw);
  on.addEventListener("change", draw);
  unpackStokes(data.stokes).then((result) => { stokes = result; draw(); },
                                 () => { figure.querySelector("[data-problem]").hidden = false; });
}
