// Written by `python tests/javascript.py types` from the TypedDicts of page.py, twin.py,
// explorer_page.py, numbers.py, motors.py and things/, which describe every key. Edit
// those files instead.

/** T in which these optional keys are present. */
export type With<T, K extends keyof T> = T & Required<Pick<T, K>>;

export type PageExplorer =
  | JointPage
  | LeversPage
  | ElbowPage
  | CrossingPage
  | TargetPage
  | MotionPage
  | RotationPage
  | SingularityPage
  | ClearancePage
  | PathsPage
  | PlanPage
  | TourPage;

export type Scale = [number, number, number, number];

export type Inverse =
  ElbowInverse | WristInverse | ScaraInverse | TwoLinkInverse | ThreeLeverInverse | NoInverse;

export type PageThing = PageFaces | PageZone | PageMark | PageTarget;

export interface Packed {
  steps: (number | number[])[];
  data: string;
}

export interface PageFaces {
  kind: "faces";
  corners: number[][][];
}

export interface ZoneSide {
  joint: number | null;
  text: string;
  dash: number[];
  points: number[][];
}

export interface PageZone {
  kind: "zone";
  elbows: ZoneSide[][];
}

export interface PageReading {
  steps: (number | number[])[];
  data: string;
  motions: number;
  samples: number;
  name: string;
  decimals: number;
}

export interface PageWay {
  steps: (number | number[])[];
  data: string;
  motions: number;
  samples: number;
}

export interface PageMark {
  kind: "mark";
  name: string | PageReading;
  radius: number;
  at: number[] | PageWay;
}

export interface PageTarget {
  kind: "target";
  name: string;
  pose: number[] | PageWay;
}

export interface PageLink {
  before: number[];
  axis: number[];
  after: number[];
  prismatic: boolean;
}

export interface Unit {
  name: string;
  size: number;
}

export interface Slider {
  label: string;
  values: number[];
  decimals: number;
}

export interface Switch {
  label: string;
  values: string[];
}

export interface PageScene {
  size: number;
  flat: number | null;
  grid: number;
  seen: number[][];
  floor: number[][];
  view: number[];
  grows: boolean;
  solid: boolean;
  bases: number[][] | null;
  things: PageThing[];
}

export interface Axis {
  unit: string;
  scale: Scale;
}

export interface PagePanel {
  label: string;
  near: number[][][];
  axes: Record<string, Axis>;
}

export interface PageQuantity {
  label: string;
  scale: Scale;
  steps: boolean;
  values: Packed[];
}

export interface Watch {
  panel: number;
  joints: number[] | null;
}

export interface Greatest {
  speed: number[][];
  share: number[][] | null;
  acceleration: (number | string)[][];
}

export interface Flaws {
  gaps: Record<string, number[]>;
  jumps: Record<string, [number, string][]>;
  leaps: Record<string, [number, string][]>;
  notes: Record<string, string[]>;
}

export interface PageArm {
  speed: number[][];
  share: number[][] | null;
  acceleration: (number | string)[][];
  gaps: Record<string, number[]>;
  jumps: Record<string, [number, string][]>;
  leaps: Record<string, [number, string][]>;
  notes: Record<string, string[]>;
  name: string;
  rows: [number, string][][] | null;
  chain: PageLink[];
  motion: Packed[];
  limits: number[][];
  speedLimits: number[] | null;
  via: (number[] | null)[] | null;
}

export interface TimePage {
  title: string;
  summary: string;
  alt: string;
  nothing: number;
  times: number[];
  ticks: Scale;
  dashes: number[][];
}

export interface Page {
  title: string;
  summary: string;
  alt: string;
  nothing: number;
  times: number[];
  ticks: Scale;
  dashes: number[][];
  slider: Slider | null;
  switch: Switch | null;
  unit: Unit;
  scene: PageScene;
  panels: PagePanel[];
  quantities: PageQuantity[];
  watch: Watch;
  decimals: number[];
  sampled: string;
  arms: PageArm[];
}

export interface CurvePanel {
  label: string;
  near: number[][][];
  axes: Record<string, Axis>;
  values: Packed;
  limits: number[][] | null;
  marks: [number, string][];
}

export interface PageCurves {
  title: string;
  summary: string;
  alt: string;
  nothing: number;
  times: number[];
  ticks: Scale;
  dashes: number[][];
  prismatic: boolean[];
  gaps: number[];
  panels: CurvePanel[];
  notes: [string, boolean][];
}

export interface PageAnswer {
  name?: string;
  text: string;
  reason: string;
  confusion: string | null;
  second: string;
  value?: number;
}

export interface PageQuestion {
  name: string;
  title: string;
  question: string;
  options: PageAnswer[];
  right: number;
  unit: string | null;
  within: number;
  choice: string | null;
}

export interface ArmData {
  name: string;
  target: string | null;
  reach: number;
  chain: PageLink[];
  limits: number[][];
  limits_in_words: string[][];
  prismatic: boolean[];
  units: JointUnit[];
  speed_limits: number[] | null;
  movable: number[];
  geometry: Inverse;
  tolerances: Tolerances;
  branches?: number[][];
  carried?: string;
  sentences?: Record<string, string>;
}

export interface Control {
  name: string;
  unit: string;
  low: number;
  high: number;
  step: number;
  decimals: number;
}

export interface PageUnit {
  name: string;
  size: number;
  code: string;
}

export interface PagePose {
  place: number[];
  rotation?: number[];
  angle?: number;
}

export interface FactRow {
  name: string;
  fact: string;
  heads: string[];
  decimals: number;
}

export interface StartValues {
  blend: number;
  duration: number;
  law: number;
  corner: number;
  row: number;
}

export interface JumpRules {
  least: number;
  few: number;
}

export interface BranchTask {
  wanted: number;
  holds: string;
  open: string;
}

export interface ExplorerPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
}

export interface ArmPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
}

export interface JointPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "joint";
  q: number[];
  rows: FactRow[];
  singular: boolean;
  wrist: number[] | null;
}

export interface PageCosts {
  title: string;
  axis: string;
  terms: string[];
  dashes: number[][];
}

export interface LeversPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "levers";
  q: number[];
  targets: PagePose[];
  curve: PageCosts;
}

export interface ElbowPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "elbow";
  point: number[];
  heads: string[];
  elbows: string[];
}

export interface CrossingPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "crossing";
  tip: number[];
  divisor: number | null;
  eliminated: string;
  rows: string[];
  heads: string[];
}

export interface TargetPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "target";
  q: number[];
  target: PagePose;
  turns: number[];
  branches: string[];
  heads: string[];
  turning: number[];
  watched: number[];
  task: BranchTask | null;
}

export interface MotionPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "motion";
  dashes: number[][];
  start: PagePose;
  via: PagePose;
  goal: PagePose;
  start_values: StartValues;
  laws: ("quintic" | "trapezoidal" | "linear")[];
  corners: ("parabola" | "quintic")[];
  branches: string[];
  panels: string[];
  samples: number;
  jumps: JumpRules;
  close_up: boolean;
}

export interface SingularityPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "singularity";
  pose: PagePose;
  along: number[];
  beside: number[];
  row: number;
  speed: number;
}

export interface ClearancePage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "clearance";
  q: number[];
  target: PagePose;
  vias: number[][];
  obstacle: number[];
  distance: number;
}

export interface RotationPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  kind: "rotation";
  axis: number[];
  across: number[];
  length: number;
  angles: number[];
  rows: string[];
  heads: string[];
  decimals: number;
}

export interface PathsPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  arm: ArmData;
  units: PageUnit[];
  kind: "paths";
  start: number[];
  goal: number[];
  per_degree: number[];
  limit: number;
  row: number;
  samples: number;
  paths: string[];
  heads: string[];
}

export interface LivePage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  question?: Record<string, unknown>;
  first?: Record<string, unknown>;
}

export interface PlanPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  question?: Record<string, unknown>;
  first?: Record<string, unknown>;
  kind: "plan";
  arm: ArmData;
  branches: string[];
  forbidden: number;
}

export interface TourPage {
  title: string;
  summary: string;
  alt: string;
  meant: string;
  unit: PageUnit;
  scene: PageScene;
  controls: Control[];
  words: Record<string, string>;
  code: string;
  question?: Record<string, unknown>;
  first?: Record<string, unknown>;
  kind: "tour";
  kinds: string[];
  tours: string[];
  best: boolean;
  speeds: number[];
  slack: number;
  most: number;
  spare: number[][];
}

export interface ElbowData {
  carried: string;
  sign1: number;
  sign2: number;
  sign3: number;
  shoulder_x: number;
  shoulder_z: number;
  lateral: number;
  upper: number;
  fore: number;
  upper_angle: number;
  fore_angle: number;
  reach: number;
}

export interface WristData {
  sign5: number;
  sign6: number;
  axis4: number;
  from_flange: number[];
  centre_from_flange: number[];
}

export interface ElbowTurns {
  upper: [number, number];
  fore: [number, number];
}

export interface WristTurns {
  upper: [number, number];
  fore: [number, number];
  axis4: [number, number];
}

export interface ElbowInverse {
  kind: "elbow";
  elbow: ElbowData;
  reach: number;
  turns: ElbowTurns;
}

export interface WristInverse {
  kind: "wrist";
  elbow: ElbowData;
  wrist: WristData;
  reach: number;
  turns: WristTurns;
}

export interface ScaraInverse {
  kind: "scara";
  height: number;
  upper: number;
  fore: number;
  reach: number;
}

export interface TwoLinkInverse {
  kind: "two_link";
  l1: number;
  l2: number;
  base: [number, number];
  reach: number;
}

export interface ThreeLeverInverse {
  kind: "three_lever";
  levers: [number, number, number];
  lever: number;
  inner: number;
  reach: number;
}

export interface NoInverse {
  kind: null;
}

export interface Tolerances {
  ROUNDING: number;
  STRAIGHT: number;
  FREE: number;
  SINGULAR: number;
  STUCK: number;
  NOISY: number;
  SLACK: number;
}

export interface JointUnit {
  name: string;
  size: number;
}

export interface PagePole {
  at: number;
  winding: number;
  sign: number;
  name: string;
}

export interface PageMotor {
  windings: number;
  turn: number;
  periods: number;
  sharp: number;
  poles: PagePole[];
  teeth: number;
  space: number;
  heads: string[];
  currents: Record<string, number[][]>;
  printed: Record<string, string[][]>;
}

export interface MotorKind {
  rotor: string;
  motor: string;
  name: string;
  motors: PageMotor[];
}

export interface MotorDrive {
  key: string;
  name: string;
}

export interface MotorNumbers {
  torque: number;
  inertia: number;
  damping: number;
  rise: number;
}

export interface MotorRules {
  fine: number[];
  settled: number;
  slowest: number;
  limit: number;
  nearly: number;
}

export interface MotorControl {
  name: string;
  unit: string;
  low: number;
  high: number;
  step: number;
  decimals: number;
  key: "end" | "load" | "inertia" | "start" | "ramp";
  size: number;
}

export interface MotorValues {
  kind: number;
  motor: number;
  drive: number;
  end: number;
  load: number;
  inertia: number;
  start: number;
  ramp: number;
}

export interface PageMotors {
  kind: string;
  title: string;
  summary: string;
  alt: string;
  meant: string;
  words: Record<string, string>;
  pulses: number;
  alone: boolean;
  rules: MotorRules;
  own: MotorNumbers;
  kinds: MotorKind[];
  drives: MotorDrive[];
  opening: MotorValues;
  controls: MotorControl[];
  code: string;
}
