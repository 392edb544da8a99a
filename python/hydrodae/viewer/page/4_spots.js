// Buoys and clumps on lines, markers, gauges, moored bodies: symbols of one size.

const SPOTS = {
  buoy: { colour: 0xffd43b, shape: (s) => new L.SphereGeometry(s, 16, 10) },
  clump: { colour: 0x343a40, shape: (s) => new L.BoxGeometry(1.5 * s, 1.5 * s, 1.5 * s) },
  marker: { colour: 0xd6336c, shape: (s) => new L.SphereGeometry(0.6 * s, 12, 8), through: true },
  gauge: { colour: 0x1971c2, shape: (s) => upright(0.2 * s, 5 * s) },
  "mooring matrix": { colour: 0x5f3dc4, shape: (s) => upright(1.2 * s, 0.5 * s), through: true },
};

function upright(radius, length) {
  return new L.CylinderGeometry(radius, radius, length, 12).rotateX(Math.PI / 2);
}

function makeSpot(spot, scene) {
  const { colour, shape, through } = SPOTS[spot.kind];
  const group = new L.Group(), geometry = shape(1);
  const paint = new L.MeshPhongMaterial({ color: colour });
  const mesh = new L.Mesh(geometry, paint);
  mesh.userData.name = spot.name;
  group.add(mesh);
  if (through) { // seen through the body that covers it
    const ghost = new L.Mesh(geometry, new L.MeshLambertMaterial(
      { color: colour, depthTest: false, transparent: true, opacity: 0.45 }));
    ghost.renderOrder = 3;
    ghost.raycast = () => {};
    group.add(ghost);
  }
  scene.add(group);
  const points = numbers(spot.points);
  const place = (sample, camera, pixel) => {
    for (let c = 0; c < 3; ++c) group.position.setComponent(c, between(points, 3, sample, c));
    const least = 4 * pixel * camera.position.distanceTo(group.position); // of four pixels at least
    group.scale.setScalar(Math.max(0.015 * RADIUS, least));
  };
  const of = spot.bodies.length ? ` of ${spot.bodies.join(" and ")}` : "";
  return { name: spot.name, group, place, paints: [paint], kind: "spot",
           origin: `${spot.kind}${of}` };
}
