// GLSL of the parts: instances with frame, top, gene and material, in packs (mesh_packs.ts), lit like a small studio: a warm key light with soft
// shadows, sky and ground, a faint light at the camera. Metals mirror that studio, not an image of one.

export const kInstanceVertex = `
precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform highp sampler2D uInstances;
in vec3 position, normal;
in float copy;
in vec2 range; // first instance of this pack, first that is another mesh's
vec3 frameX, frameY, frameZ, origin;
vec4 extra; // top, gene, material, layer

/** False where there is nothing to see: a copy without an instance, or a proxy. */
bool takeInstance() {
  float number = range.x + copy;
  if (number >= range.y) return false;
  int n = int(number + 0.5);
  ivec2 at = ivec2(4 * (n % 256), n / 256);
  vec4 a = texelFetch(uInstances, at, 0), b = texelFetch(uInstances, at + ivec2(1, 0), 0);
  vec4 c = texelFetch(uInstances, at + ivec2(2, 0), 0);
  extra = texelFetch(uInstances, at + ivec2(3, 0), 0);
  frameX = a.xyz;
  frameY = vec3(a.w, b.xy);
  frameZ = vec3(b.zw, c.x);
  origin = c.yzw;
  return extra.w < 0.5 || extra.w > 1.5;
}

vec3 worldPosition() {
  vec3 p = position;
  p.xz *= 1.0 + (extra.x - 1.0) * (p.y + 0.5);
  return origin + frameX * p.x + frameY * p.y + frameZ * p.z;
}

vec3 worldNormal() {
  vec3 n = normal;
  // The side of a cone leans by half of what it loses in width over its height of 1.
  n.y += 0.5 * (1.0 - extra.x) * length(n.xz);
  // Cofactors: of mirrored frames they point inwards, and so do their front faces; the fragment shader makes it good.
  vec3 cofactor = cross(frameY, frameZ) * n.x + cross(frameZ, frameX) * n.y + cross(frameX, frameY) * n.z;
  float l = length(cofactor);
  return l > 0.0 ? cofactor / l : vec3(0, 1, 0);
}
`;

export const kPartsVertex = `${kInstanceVertex}
uniform highp sampler2D uMaterials, uMarks;
uniform int uMarkWidth;
out vec3 vWorld, vNormal;
flat out vec4 vColour, vEmission;
flat out vec3 vSurface;
void main() {
  if (!takeInstance()) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vWorld = worldPosition();
  vNormal = worldNormal();
  int m = int(extra.z + 0.5), g = int(extra.y + 0.5);
  ivec2 at = ivec2(3 * (m % 64), m / 64);
  vColour = texelFetch(uMaterials, at, 0);
  vEmission = texelFetch(uMaterials, at + ivec2(1, 0), 0);
  vec4 surface = texelFetch(uMaterials, at + ivec2(2, 0), 0);
  float mark = floor(texelFetch(uMarks, ivec2(g % uMarkWidth, g / uMarkWidth), 0).r * 255.0 + 0.5);
  vSurface = vec3(surface.xy, mark);
  gl_Position = projectionMatrix * viewMatrix * vec4(vWorld, 1);
}`;

export const kPartsFragment = `
precision highp float;
precision highp int;
precision highp sampler2DShadow;
uniform vec3 cameraPosition;
uniform vec3 uKey, uAccent, uLocked;
uniform float uDim, uLight;
#ifdef SHADOWS
uniform sampler2DShadow uShadow;
uniform mat4 uShadowMatrix;
uniform vec2 uShadowSize; // a texel of the map, metres per texel
#endif
in vec3 vWorld, vNormal;
flat in vec4 vColour, vEmission;
flat in vec3 vSurface;
out vec4 outColour;

float noise(vec2 p) { return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); }

vec3 studio(vec3 d, float rough) {
  float soft = 0.15 + rough;
  vec3 up = mix(vec3(0.40, 0.42, 0.45), vec3(0.72, 0.76, 0.82), smoothstep(-0.2, 0.8, d.y));
  vec3 sky = mix(vec3(0.24, 0.23, 0.22), up, smoothstep(-soft, soft, d.y));
  float wall = smoothstep(0.5 + 0.3 * rough, 0.0, abs(d.y - 0.25)) * (1.0 - rough) * 0.35;
  return sky + wall;
}

float lit(vec3 world, vec3 n) {
#ifdef SHADOWS
  vec4 p = uShadowMatrix * vec4(world + n * uShadowSize.y * 1.6, 1);
  if (p.z >= 1.0 || any(lessThan(p.xy, vec2(0))) || any(greaterThan(p.xy, vec2(1)))) return 1.0;
  float angle = 6.2831853 * noise(gl_FragCoord.xy), sum = 0.0;
  for (int i = 0; i < 6; ++i) {
    float a = angle + float(i) * 2.399963, r = sqrt((float(i) + 0.5) / 6.0) * 2.4;
    sum += texture(uShadow, vec3(p.xy + vec2(cos(a), sin(a)) * r * uShadowSize.x, p.z));
  }
  return sum / 6.0;
#else
  return 1.0;
#endif
}

void main() {
  if (vColour.a < 0.99 && vColour.a < noise(gl_FragCoord.xy + vec2(7.0))) discard;
  vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0), v = normalize(cameraPosition - vWorld);
  if (dot(n, v) < 0.0) n = normalize(n - 1.02 * dot(n, v) * v);
  float rough = clamp(vSurface.x, 0.06, 1.0), metal = vSurface.y, nl = dot(n, uKey), nv = max(dot(n, v), 1e-3);
  float shadow = nl > 0.0 ? lit(vWorld, n) : 0.0;
  float key = max(nl, 0.0) * shadow;
  vec3 base = vColour.rgb;
  // Diffuse: key, sky above and its light from the ground below, a little from the camera.
  vec3 around = mix(vec3(0.21, 0.20, 0.19), vec3(0.47, 0.51, 0.57), 0.5 + 0.5 * n.y);
  vec3 diffuse = base * (1.0 - metal) * (around + vec3(1.62, 1.54, 1.42) * key + 0.16 * nv);
  // Specular: GGX of the key (Karis 2013), the studio's mirror image.
  vec3 h = normalize(uKey + v), f0 = mix(vec3(0.04), base, metal);
  float a2 = rough * rough * rough * rough, nh = max(dot(n, h), 0.0), d = nh * nh * (a2 - 1.0) + 1.0;
  float k = 0.125 * (rough + 1.0) * (rough + 1.0);
  float gloss = a2 / (4.0 * d * d * (max(nl, 0.0) * (1.0 - k) + k) * (nv * (1.0 - k) + k));
  vec3 fresnel = f0 + (max(vec3(1.0 - rough), f0) - f0) * pow(1.0 - nv, 5.0);
  vec3 light = diffuse + f0 * min(gloss, 40.0) * key * 0.9;
  light += fresnel * studio(reflect(-v, n), rough) * (1.0 - 0.45 * rough);
  light = light * uLight + vEmission.rgb * vEmission.a;

  int mark = int(vSurface.z);
  if (uDim > 0.0) {
    if ((mark & 3) == 0) light = mix(light, vec3(dot(light, vec3(0.2, 0.7, 0.1))) * 0.55, 0.72);
    else {
      float rim = pow(1.0 - nv, 2.0), much = (mark & 2) != 0 ? 1.0 : 0.75;
      light += uAccent * much * (0.07 + 0.75 * rim);
    }
  }
  if ((mark & 4) != 0 && mod(gl_FragCoord.x + gl_FragCoord.y, 9.0) < 2.6) light = mix(light, uLocked, 0.62);

  light *= 0.86;
  light = clamp((light * (2.51 * light + 0.03)) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0);
  outColour = vec4(mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light)), 1);
}`;

export const kShadowVertex = `${kInstanceVertex}
void main() {
  if (!takeInstance()) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  gl_Position = projectionMatrix * viewMatrix * vec4(worldPosition(), 1);
}`;

export const kShadowFragment = `
precision mediump float;
out vec4 outColour;
void main() { outColour = vec4(1); }`;
