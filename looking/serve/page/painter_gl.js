// Draws pictures into rectangles of a canvas by WebGL, which tone maps them.
import {glsl} from './tone.js';

const vertex = `#version 300 es
uniform vec4 rect;  // x, y, width, height in clip space
out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(rect.x + at.x * rect.z, rect.y - at.y * rect.w, 0, 1);
}`;
const fragment = `#version 300 es
precision highp float;
precision highp int;
uniform sampler2D image;
uniform int kind, tone, channels;
uniform float exposure;
uniform vec2 range;
in vec2 at;
out vec4 colour;
${glsl}
void main() { colour = vec4(shown(texture(image, at).rgb, kind, tone, channels, exposure, range), 1); }`;

export class GlPainter {
  #textures = new Map();  // by picture
  #at = {};

  // Throws if the browser cannot.
  constructor(canvas) {
    this.canvas = canvas;
    const gl = this.gl = canvas.getContext('webgl2', {alpha: true, antialias: false});
    if (!gl) throw new Error('no WebGL 2');
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source), gl.compileShader(shader), gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    }
    gl.linkProgram(program), gl.useProgram(program);
    for (const name of ['rect', 'kind', 'tone', 'channels', 'exposure', 'range'])
      this.#at[name] = gl.getUniformLocation(program, name);
    gl.bindVertexArray(gl.createVertexArray());
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.enable(gl.SCISSOR_TEST);
  }

  begin() {
    const {gl, canvas} = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.scissor(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0), gl.clear(gl.COLOR_BUFFER_BIT);
  }

  // `rect` and `clip`: {x, y, width, height} in the canvas's pixels, from the top.
  draw(picture, rect, clip, view) {
    const {gl, canvas} = this, W = canvas.width, H = canvas.height;
    if (clip.width < 1 || clip.height < 1) return;
    gl.scissor(Math.round(clip.x), Math.round(H - clip.y - clip.height), Math.round(clip.width), Math.round(clip.height));
    gl.bindTexture(gl.TEXTURE_2D, this.#texture(picture));
    const filter = picture.bytes === 4 && !picture.is_smooth || rect.width >= 2 * picture.width ? gl.NEAREST : gl.LINEAR;
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.uniform4f(this.#at.rect, rect.x / W * 2 - 1, 1 - rect.y / H * 2, rect.width / W * 2, rect.height / H * 2);
    gl.uniform1i(this.#at.kind, view.kind), gl.uniform1i(this.#at.tone, view.tone);
    gl.uniform1i(this.#at.channels, picture.channels), gl.uniform1f(this.#at.exposure, view.exposure);
    gl.uniform2f(this.#at.range, ...view.range);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  // Pictures that were not drawn lose their textures.
  end(drawn) {
    for (const [picture, texture] of this.#textures)
      if (!drawn.has(picture)) this.gl.deleteTexture(texture), this.#textures.delete(picture);
  }

  #texture(picture) {
    if (this.#textures.has(picture)) return this.#textures.get(picture);
    const {gl} = this, texture = gl.createTexture(), c = picture.channels - 1, is_half = picture.bytes === 2;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const inner = is_half ? [gl.R16F, gl.RG16F, gl.RGB16F][c] : [gl.R32F, gl.RG32F, gl.RGB32F][c];
    gl.texImage2D(gl.TEXTURE_2D, 0, inner, picture.width, picture.height, 0, [gl.RED, gl.RG, gl.RGB][c],
                  is_half ? gl.HALF_FLOAT : gl.FLOAT, picture.data);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    this.#textures.set(picture, texture);
    return texture;
  }
}
