// The wetted part of a mesh: cut where the solver cuts it, with its water line.

/// Paint of what is wet: darker and bluer.
const WETTED = `vec3 wetted(vec3 dry) { return mix(dry, vec3(0.004, 0.04, 0.14), 0.72); }`;

/// Dry or wet by the height above the water, which is linear over a triangle as it is to the solver;
/// between them a white line of about three pixels.
const CUT = `vec3 cut(vec3 dry, vec3 wet, float height) {
  float pixels = abs(height) / max(fwidth(height), 1e-20);
  return mix(height < 0.0 ? wet : dry, vec3(1.0), 1.0 - smoothstep(1.0, 2.0, pixels));
}`;

/// Makes a lit material show the cut; its geometry has the attribute `level` [m].
function cutMaterial(material) {
  material.userData.cut = true; // what stands for it while it plays needs to know
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", "attribute float level;\nvarying float height;\nvoid main() {\n  height = level;");
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `varying float height;\n${WETTED}\n${CUT}\nvoid main() {`)
      .replace("#include <color_fragment>",
        "diffuseColor.rgb = cut(diffuseColor.rgb, wetted(diffuseColor.rgb), height);");
  };
  return material;
}

/// Sets the heights of the corners of a surface above the waves, or above z = 0, at a time.
function levels(geometry, group, cut) {
  const corners = geometry.attributes.position, at = new L.Vector3();
  const level = new L.BufferAttribute(new Float32Array(corners.count), 1);
  geometry.setAttribute("level", level);
  return (time) => {
    group.updateMatrix();
    const elevation = cut === "waves" ? elevationAt(time) : () => 0;
    for (let i = 0; i < corners.count; ++i) {
      at.fromBufferAttribute(corners, i).applyMatrix4(group.matrix);
      level.array[i] = at.z - elevation(at.x, at.y);
    }
    level.needsUpdate = true;
  };
}
