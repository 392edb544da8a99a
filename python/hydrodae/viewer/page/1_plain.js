// Surfaces lit at their corners only, for browsers in which the processor draws: a third of the time.

/// Light as three.js has it: a sky above and below, and a sun; Lambert's law, both sides of a surface.
const LIT_AT_CORNERS = `
  uniform vec3 diffuse, emissive, sky, ground, sun, toSun;
  uniform float opacity;
  varying vec4 front, back;
  #ifdef PAINTED
    attribute vec4 color;
  #endif
  #ifdef CUT
    attribute float level;
    varying float height;
    varying vec4 wetFront, wetBack;
    ${WETTED}
  #endif
  vec4 lit(vec4 paint, vec3 n) {
    vec3 light = mix(ground, sky, 0.5 * n.z + 0.5) + sun * max(dot(n, toSun), 0.0);
    vec3 c = clamp(paint.rgb * light * 0.31830989 + emissive, 0.0, 1.0);
    return vec4(mix(1.055 * pow(c, vec3(0.41666)) - 0.055, 12.92 * c, step(c, vec3(0.0031308))), paint.a);
  }
  void main() {
    vec4 place = vec4(position, 1.0), paint = vec4(diffuse, opacity);
    vec3 n = normal;
    #ifdef USE_INSTANCING
      place = instanceMatrix * place, n = mat3(instanceMatrix) * n;
    #endif
    #ifdef USE_INSTANCING_COLOR
      paint.rgb *= instanceColor.rgb;
    #endif
    #ifdef PAINTED
      paint *= color;
    #endif
    gl_Position = projectionMatrix * (modelViewMatrix * place);
    n = normalize(mat3(modelMatrix) * n);
    front = lit(paint, n), back = lit(paint, -n);
    #ifdef CUT
      height = level;
      paint.rgb = wetted(paint.rgb);
      wetFront = lit(paint, n), wetBack = lit(paint, -n);
    #endif
  }`;
const AS_LIT = `
  varying vec4 front, back;
  #ifdef CUT
    varying float height;
    varying vec4 wetFront, wetBack;
    ${CUT}
  #endif
  void main() {
    gl_FragColor = gl_FrontFacing ? front : back;
    #ifdef CUT
      gl_FragColor.rgb = cut(gl_FragColor.rgb, (gl_FrontFacing ? wetFront : wetBack).rgb, height);
    #endif
  }`;

/// Lights of the scene, shared by all plain materials; `aim` follows the sun.
function makeLights(scene) {
  const above = new L.HemisphereLight(0xffffff, 0x8fa3b0, 1.7);
  above.position.set(0, 0, 1);
  const sun = new L.DirectionalLight(0xfff4e0, 2.1);
  scene.add(above, sun, sun.target);
  const strong = (light, colour) => ({ value: colour.clone().multiplyScalar(light.intensity) });
  const uniforms = {
    sky: strong(above, above.color), ground: strong(above, above.groundColor),
    sun: strong(sun, sun.color), toSun: { value: new L.Vector3() },
  };
  const aim = (camera, target) => {
    sun.position.copy(camera.position);
    sun.position.z += 2 * RADIUS;
    sun.target.position.copy(target);
    uniforms.toSun.value.subVectors(sun.position, target).normalize();
  };
  return { uniforms, aim };
}

/// Every surface of the scene with its own material and the plain one that stands for it.
class Surfaces {
  constructor(scene, lights) {
    this.plain = false, this.pairs = [];
    const made = new Map();
    scene.traverse((mesh) => {
      if (!mesh.isMesh) return;
      const full = mesh.material;
      if (!made.has(full)) made.set(full, this.plainOf(full, lights));
      this.pairs.push({ mesh, full, plain: made.get(full) });
    });
  }

  plainOf(full, lights) {
    const none = { value: new L.Color(0) };
    return new L.ShaderMaterial({
      vertexShader: LIT_AT_CORNERS, fragmentShader: AS_LIT, depthTest: full.depthTest,
      defines: { ...(full.vertexColors && { PAINTED: 1 }), ...(full.userData.cut && { CUT: 1 }) },
      forceSinglePass: true,
      polygonOffset: full.polygonOffset, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      uniforms: { ...lights, diffuse: { value: full.color }, opacity: { value: 1 },
                  emissive: full.emissive ? { value: full.emissive } : none },
    });
  }

  show(plain) {
    for (const pair of this.pairs) {
      const { mesh, full } = pair, own = pair.plain;
      mesh.material = plain ? own : full;
      own.uniforms.opacity.value = full.opacity;
      own.transparent = full.transparent, own.depthWrite = full.depthWrite, own.side = full.side;
    }
  }
}
