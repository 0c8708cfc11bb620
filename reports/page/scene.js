// What is seen of the machine at a time and from a side, as attributes of the elements of its drawing: as
// reports/drawing/scene.cpp finds them for paper; tests/reports/page/vectors.json holds both to the same texts.
"use strict";

/** @typedef {[number, number, number]} Place */
/** @typedef {[number, number]} Sight */
/** @typedef {{row: number, right: Place, up: Place}} Stance */
/**
 * As sceneData (reports/drawing/scene.hpp) writes it. Places are [row][point][direction] in whole units, null where unknown.
 * @typedef {{unit: number, width: number, height: number, pin: number, right: Place, up: Place, vertical: Place, isSide: boolean,
 *   time: number[], points: number, shapes: Shape[], links: [number, number][], moving: number[],
 *   nominal: (number | null)[], axes: (number | null)[], samples: (number | null)[], lower: (number | null)[],
 *   upper: (number | null)[], sag: (number | null)[], roads: (number | null)[][]}} Scene
 */
/** Form, from, to, size, axis, other (reports/drawing/scene.hpp). @typedef {[string, number, number, number, number, number]} Shape */

/** @param {Place} a @param {Place} b */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** @param {Place} a @param {Place} b @returns {Place} */
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** @param {number[]} sight */
const pair = ([x, y]) => x.toFixed(1) + " " + y.toFixed(1);
/** @param {Sight} a @param {Sight} b */
const line = (a, b) => "M" + pair(a) + "L" + pair(b);

/** Places as seen from a straight line: along its length as a share, aside in units of the paper. @param {Sight} a @param {Sight} b */
const beside = (a, b) => {
  const dx = b[0] - a[0], dy = b[1] - a[1], length = Math.hypot(dx, dy);
  return {
    length,
    /** @param {number} along @param {number} aside */
    at: (along, aside) => {
      const part = aside / length;
      return pair([a[0] + along * dx - part * dy, a[1] + along * dy + part * dx]);
    }
  };
};

/** Nine turns between two straight ends, beside the line. @param {Sight} a @param {Sight} b @param {number} aside */
const zigzag = (a, b, aside) => {
  const { length, at } = beside(a, b), end = 0.14;
  let path = "M" + pair(a);
  if (length > 1 && aside !== 0) path += "L" + at(0, aside);
  for (let i = 0; length > 1 && i <= 18; ++i)
    path += "L" + at(end + (1 - 2 * end) * i / 18, aside + (i % 2 === 0 ? 0 : i % 4 === 1 ? 6 : -6));
  if (length > 1 && aside !== 0) path += "L" + at(1, aside);
  return path + "L" + pair(b);
};

/** A cylinder, which is open towards the second point, and a piston in it. @param {Sight} a @param {Sight} b @param {number} aside */
const dashpot = (a, b, aside) => {
  const { length, at } = beside(a, b), half = 5, closed = 0.36, piston = 0.52, open = 0.66;
  if (!(length > 1)) return line(a, b);
  return "M" + pair(a) + "L" + at(0, aside) + "L" + at(closed, aside) +
    "M" + [[open, half], [closed, half], [closed, -half], [open, -half]].map(([x, y]) => at(x, aside + y)).join("L") +
    "M" + at(piston, aside + (half - 1)) + "L" + at(piston, aside + (1 - half)) +
    "M" + at(piston, aside) + "L" + at(1, aside) + "L" + pair(b);
};

/**
 * A line, and short ones from every fourth place of it, backwards and down.
 * @param {(Sight | null)[]} places @param {Sight} ahead @param {Sight} up
 */
const ground = (places, [ax, ay], [ux, uy]) => {
  const every = 4, back = 4, down = 6;
  let path = "", hatch = "", isBegun = false;
  places.forEach((place, k) => {
    if (place) path += (isBegun ? "L" : "M") + pair(place);
    if (place && k % every === every / 2) hatch += line(place, [place[0] - back * ax - down * ux, place[1] - back * ay - down * uy]);
    isBegun = place !== null;
  });
  return path + hatch;
};

/** The least convex polygon that holds all of these. @param {Sight[]} sights */
const hull = sights => {
  /** @param {Sight[]} list */
  const chain = list => {
    /** @type {Sight[]} */
    const found = [];
    for (const p of list) {
      for (let n = found.length; n >= 2; --n) {
        const a = found[n - 2], b = found[n - 1];
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        found.pop();
      }
      found.push(p);
    }
    return found.slice(0, -1);  // the last begins the other chain
  };
  const sorted = [...sights].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const corners = [...chain(sorted), ...chain(sorted.reverse())];
  return corners.length === 0 ? "" : "M" + corners.map(pair).join("L") + "Z";
};

/** @param {Place} v @param {number} factor @returns {Place} */
const scaled = ([x, y, z], factor) => [factor * x, factor * y, factor * z];
/** @param {Place} a @param {Place} b @returns {Place} */
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** Of the axes there are as many a row as pins name. @param {Scene} scene */
const axesOf = ({ axes, time }) => axes.length / (3 * time.length);

/** The scene as it is seen at a time from a side. */
export class Picture {
  /** @param {Scene} scene @param {Stance} stance */
  constructor(scene, stance) {
    this.scene = scene;
    this.stance = stance;
  }

  /** @param {(number | null)[]} list @param {number} row @param {number} k @param {number} [count] @returns {Place | null} */
  at(list, row, k, count = this.scene.points) {
    const from = 3 * (row * count + k), found = list.slice(from, from + 3);
    return found.length < 3 || found.includes(null) ? null : /** @type {Place} */ (found);
  }

  /** @param {Place} place @returns {Sight} */
  seen(place) {
    const { scene: { unit, width, height }, stance: { right, up } } = this;
    return [width / 2 + unit * dot(place, right), height / 2 - unit * dot(place, up)];
  }

  /** @param {(number | null)[]} list @param {number} row @param {number} k */
  point(list, row, k) {
    const place = this.at(list, row, k);
    return place && this.seen(place);
  }

  /** @param {Place | null} vector @returns {Sight} */
  direction(vector) {
    return vector ? [dot(vector, this.stance.right), 0 - dot(vector, this.stance.up)] : [0, 0];
  }

  /** Corners of the box of a point, wider by this room; none if not known. @param {number} row @param {number} k @param {Place | null} room */
  box(row, k, room) {
    const lower = this.at(this.scene.lower, row, k), upper = this.at(this.scene.upper, row, k);
    if (!lower || !upper || !room) return [];
    /** @param {number} corner @param {0 | 1 | 2} d */
    const side = (corner, d) => corner >> d & 1 ? upper[d] + room[d] : lower[d] - room[d];
    return [0, 1, 2, 3, 4, 5, 6, 7].map(corner => this.seen([side(corner, 0), side(corner, 1), side(corner, 2)]));
  }

  now() {
    return this.scene.moving.map(k => hull(this.box(this.stance.row, k, [0, 0, 0]))).join("");
  }

  swept() {
    const { moving, time, sag } = this.scene;
    return moving.map(k => time.map((_, row) => {
      const room = row > 0 ? this.at(sag, row, k) : null, before = this.box(row - 1, k, room), after = this.box(row, k, room);
      return before.length > 0 && after.length > 0 ? hull([...before, ...after]) : "";
    }).join("")).join("");
  }

  /** @param {number} number */
  sample(number) {
    const { links, samples, time } = this.scene, row = number * time.length + this.stance.row;
    return links.map(([from, to]) => {
      const a = this.point(samples, row, from), b = this.point(samples, row, to);
      return a && b ? line(a, b) : "";
    }).join("");
  }

  /** @param {string} form @param {number} number @returns {Record<string, string> | null} */
  directionShape(form, number) {
    const [dx, dy] = this.direction([number === 0 ? 1 : 0, number === 1 ? 1 : 0, number === 2 ? 1 : 0]);
    const x = 30, y = this.scene.height - 30;
    if (Math.hypot(dx, dy) <= 0.2) return null;
    if (form === "arrow") return { d: line([x, y], [x + 20 * dx, y + 20 * dy]) };
    return { x: (x + 28 * dx).toFixed(1), y: (y + 28 * dy + 4).toFixed(1) };
  }

  /** Its rim, and a spoke; nothing where the axle or the spoke is unknown. @param {Sight} centre @param {number} number @param {number} radius */
  wheel([x, y], number, radius) {
    const count = axesOf(this.scene), axle = this.at(this.scene.axes, this.stance.row, number, count),
      spoke = this.at(this.scene.axes, this.stance.row, number + 1, count), corners = 32;
    if (!axle || !spoke) return "";
    const [ux, uy] = this.direction(spoke), [vx, vy] = this.direction(cross(axle, spoke));
    /** @type {Sight[]} */
    const rim = Array.from({ length: corners }, (_, k) => {
      const a = radius * Math.cos(2 * Math.PI * k / corners), b = radius * Math.sin(2 * Math.PI * k / corners);
      return [x + a * ux + b * vx, y + a * uy + b * vy];
    });
    return "M" + rim.map(pair).join("L") + "Z" + line([x, y], [x + radius * ux, y + radius * uy]);
  }

  /** @param {number} number */
  axis(number) {
    return this.at(this.scene.axes, this.stance.row, number, axesOf(this.scene));
  }

  /** What of a plane lies beneath a point; hatched below where it is seen from its edge. @param {Shape} shape */
  plane([, from, to, size, number]) {
    const { scene: { nominal }, stance: { row, right, up } } = this;
    const normal = this.axis(number), through = this.at(nominal, row, from), over = this.at(nominal, row, to);
    if (!normal || !through || !over) return "";
    const [x, y] = this.seen(minus(over, scaled(normal, dot(minus(over, through), normal)))), toBeholder = cross(right, up);
    const across = cross(normal, toBeholder), length = Math.hypot(...across), level = length < 0.01 ? right : scaled(across, 1 / length);
    const [lx, ly] = this.direction(level), [ax, ay] = [lx * size, ly * size];
    const [bx, by] = this.direction(cross(normal, level)).map(part => part * (0.6 * size));
    if (Math.abs(dot(normal, toBeholder)) >= 0.05)
      return "M" + [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => pair([x + a * ax + b * bx, y + a * ay + b * by])).join("L") + "Z";
    const steps = 12;
    /** @type {Sight[]} */
    const places = Array.from({ length: 2 * steps + 1 }, (_, k) => [x + (k - steps) * ax / steps, y + (k - steps) * ay / steps]);
    return ground(places, [lx, ly], this.direction(normal));
  }

  /** The profile beneath a point, hatched below. @param {Sight} centre @param {Shape} shape */
  road([x, y], [, profile, , size, number]) {
    const { roads, time, unit } = this.scene, heights = roads[profile], steps = heights.length / time.length;
    const up = this.axis(number), ahead = this.axis(number + 1);
    if (!up || !ahead || steps < 2) return "";
    const [ux, uy] = this.direction(up), [ax, ay] = this.direction(ahead);
    const places = heights.slice(this.stance.row * steps, (this.stance.row + 1) * steps).map((whole, k) => {
      if (whole === null) return null;
      const along = (2 * k / (steps - 1) - 1) * size, height = unit * whole;
      return /** @type {Sight} */ ([x + along * ax + height * ux, y + along * ay + height * uy]);
    });
    return ground(places, [ax, ay], [ux, uy]);
  }

  /** Two straight lines around two wheels; none where one of them is within the other. @param {Shape} shape */
  belt([, from, to, size, number, other]) {
    const { nominal, unit } = this.scene, { row } = this.stance;
    const axle = this.axis(number), first = this.at(nominal, row, from), second = this.at(nominal, row, to);
    if (!axle || !first || !second) return "";
    const way = minus(second, first), across = scaled(minus(way, scaled(axle, dot(way, axle))), unit);
    const distance = Math.hypot(...across), along = (size - other) / distance, aside = Math.sqrt(1 - along * along);
    if (!(Math.abs(along) < 1)) return "";
    const e = scaled(across, 1 / distance), [ex, ey] = this.direction(e), [cx, cy] = this.direction(cross(axle, e));
    const [px, py] = this.seen(first), [qx, qy] = this.seen(second);
    return [aside, -aside].map(side => {
      const x = along * ex + side * cx, y = along * ey + side * cy;
      return line([px + size * x, py + size * y], [qx + other * x, qy + other * y]);
    }).join("");
  }

  /** @param {Sight} at @param {number} number */
  pin([x, y], number) {
    const [dx, dy] = this.direction(this.axis(number)).map(part => this.scene.pin * part);
    return line([x - dx, y - dy], [x + dx, y + dy]);
  }

  /** From the one place to the other, or about the latter. @param {Shape} shape @param {Sight} a @param {Sight} b */
  path(shape, a, b) {
    const [form, from, , size] = shape;
    if (form === "pin") return this.pin(b, from);
    if (form === "wheel") return this.wheel(b, from, size);
    if (form === "belt" || form === "plane") return this[form](shape);
    if (form === "road") return this.road(b, shape);
    if (form === "zigzag") return zigzag(a, b, size);
    return form === "dashpot" ? dashpot(a, b, size) : line(a, b);
  }

  /** What moves of an element; null where it is not seen. @param {Shape} shape @returns {Record<string, string> | null} */
  attributesOf(shape) {
    const [form, from, to] = shape;
    if (form === "sample") return { d: this.sample(from) };
    if (form === "now" || form === "swept") return { d: this[form]() };
    if (form === "arrow" || form === "letter") return this.directionShape(form, from);
    const { nominal } = this.scene, { row } = this.stance;
    const isAtOne = form === "pin" || form === "wheel" || form === "road";
    const b = this.point(nominal, row, to), a = isAtOne ? b : this.point(nominal, row, from);
    if (!a || !b) return null;
    const [x, y] = b;
    if (form === "circle") return { cx: x.toFixed(1), cy: y.toFixed(1) };
    if (form === "name") return { x: (x + 15).toFixed(1), y: (y - 9).toFixed(1) };
    if (form === "sign") return { transform: "translate(" + pair(b) + ")" };
    return { d: this.path(shape, a, b) };
  }
}

/** Turned about an axis. @param {Place} v @param {Place} about @param {number} angle @returns {Place} */
const turned = (v, about, angle) => {
  const c = Math.cos(angle), s = Math.sin(angle), d = dot(about, v) * (1 - c);
  /** @param {0 | 1 | 2} i @param {0 | 1 | 2} j @param {0 | 1 | 2} k */
  const part = (i, j, k) => v[i] * c + (about[j] * v[k] - about[k] * v[j]) * s + about[i] * d;
  const [x, y, z] = [part(0, 1, 2), part(1, 2, 0), part(2, 0, 1)], length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
};

/**
 * As it is dragged, in radians: about the upward direction, then about the paper's horizontal, no further than straight down.
 * @template {{right: Place, up: Place}} Side
 * @param {Side} side @param {Place} vertical @param {number} across @param {number} down @returns {Side}
 */
export const dragged = (side, vertical, across, down) => {
  const right = turned(side.right, vertical, -across), level = turned(side.up, vertical, -across), up = turned(level, right, down);
  return { ...side, right, up: dot(up, vertical) > -1e-9 ? up : level };
};
