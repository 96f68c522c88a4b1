// SPDX-License-Identifier: MIT
// What the program writes into the page; renderer/inspect says what each of them is.

type Plane = Float64Array | Uint8Array | Uint16Array | Int16Array | Uint32Array;

interface SolverText {
  name: string;
  doc: string;
}

interface PackedView {
  resolution: [number, number];
  solvers: SolverText[];
  names: Record<string, string>;
  planes: [string, string][];
  bytes: string;
}

interface View {
  width: number;
  height: number;
  solvers: SolverText[];
  names: Record<string, string>;
  planes: Record<string, Plane>;
}

interface About {
  name: string;
  description: string;
  served: boolean;
  statuses: string[];
  paths: string[];
  objects: string[];
  camera: { position: number[]; look_at: number[]; up: number[] };
  all_solvers: SolverText[];
  view: PackedView;
}

interface MeshData {
  v: number[];
  t: number[];
}

/** The mesh around a triangle; coordinates from the middle, in the mesh's frame. */
interface Body extends MeshData {
  scale: number;
  middle: number[];
  coarse: boolean;
}

interface ShapeMesh {
  rank: number;
  scale?: number;
  inner?: MeshData;
  outer?: MeshData;
  /** Of a triangle: the number of its mesh, and the triangle's middle in the mesh's frame. */
  body?: number;
  at?: number[];
  /** The mesh itself. */
  around?: Body;
}

/** lambda, case, lambda_clip, lower, upper, v, p, w, simplex (numbers of steps, or points) */
type CastStep = [
  number, number, number | null, number | null, number | null, number[], number[], number[], (number | number[])[],
];

interface Cast {
  status: string;
  path: string;
  t?: number;
  t_lo?: number | null;
  t_hi?: number | null;
  normal: number[];
  iterations: number;
  supports: number;
  radius: number;
  s: number[];
  r: number[];
  lambda: [number | null, number | null];
  t_of: [number, number, number];
  steps: CastStep[];
}

interface RayLine {
  kind: 'ray';
  at: [number, number];
  solver: number;
  object: number;
  /** Of a mesh. */
  triangle?: number;
  shape: number;
  origin: number[];
  direction: number[];
  cast: Cast;
}

interface ShapeLine {
  kind: 'shape';
  shape: number;
  mesh: ShapeMesh;
}

interface BodyLine {
  kind: 'body';
  body: number;
  mesh: Body;
}

interface DistanceStep {
  v: number[];
  w: number[];
  v_next: number[];
  lower: number;
  upper: number;
  before: number[][];
  after: number[][];
}

interface DistanceReplay {
  status: string;
  distance: number;
  lower: number;
  iterations: number;
  supports: number;
  point_a: number[];
  point_b: number[];
  axis: number[];
  steps: DistanceStep[];
  x?: number[];
  mirrored_at?: number[];
  outline?: number[][];
}

interface PairReplay {
  a: number;
  b: number;
  /** Of meshes. */
  triangle_a?: number;
  triangle_b?: number;
  mesh: ShapeMesh;
  distance: DistanceReplay;
  impact: Cast;
  plane: DistanceReplay;
}

interface PairLine {
  kind: 'pair';
  pair: PairReplay;
}

type Line = RayLine | ShapeLine | BodyLine | PairLine;

/** A line's ray, with its shape's mesh. */
interface RayReplay extends RayLine {
  mesh: ShapeMesh;
}

/** Something to draw in space. */
type Item =
  | { kind: 'line'; points: number[][]; colour: string; width: number; dash?: number[] }
  | { kind: 'dot'; at: number[]; radius: number; colour: string; hollow?: boolean; label?: string }
  | { kind: 'area'; points: number[][]; colour: string; alpha: number; outline?: number }
  | { kind: 'arrow'; from: number[]; to: number[]; colour: string; label?: string };

/** A step of a replay, ready to be shown. */
interface Shown {
  items: Item[];
  sentence: string;
  formulas: [string, string][];
  focus: number[];
  focus_size: number;
}

/** Anything that is replayed. */
interface Play {
  mesh: ShapeMesh | null;
  radius: number;
  count: number;
  flat: boolean;
  summary: string;
  quantity: string;
  /** Where the number line begins and ends, and what is found there, if anything. */
  range: [number, number];
  answer: number | null;
  columns: string[];
  rows: string[][];
  look: { right: number[]; up: number[] };
  show(step: number, earlier: boolean): Shown;
  bounds(step: number): [number, number];
  gaps: { name: string; values: (number | null)[] }[];
}
