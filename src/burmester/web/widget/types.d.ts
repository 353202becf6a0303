// What the modules of the page hand each other, and what the server and its workers tell them.

/** Where the body is: the origin of M in F, its angle in radians, and the joints of links between joints. */
export interface Place {
  x: number;
  y: number;
  a: number;
  joints?: Record<string, number[]>;
}

/** A point, a direction or another row of numbers. */
export type Vector = number[];

/** Numbers of the frames of a way, of an array of either kind. */
export type Values = ArrayLike<number>;

/** A dyad; which of its pivots, its line and its length it has, its kind says. */
export interface Dyad {
  kind: string;
  fixed_pivot: Vector;
  moving_pivot: Vector;
  radius: number;
  angle_deg: number;
  line: { normal_deg: number; offset: number };
}

/** A way of a linkage: the place of its body at every frame, and its joints where it has more than two dyads. */
export interface Way {
  x: Values;
  y: Values;
  angle: Values;
  round: boolean;
  joints?: Record<string, [Values, Values]>;
  [more: string]: any;
}

/** Where a linkage is at a pose; on no way where `way` is null. */
export interface AtPose {
  at?: Way;
  way: number | null;
  frame: number;
  x: number;
  y: number;
  angle_deg: number;
}

/** A linkage as the page moves it: its dyads, the driver's first, and where it is at each pose. */
export interface Moved {
  led: Dyad[];
  ground?: Record<string, Vector>;
  pose_errors: AtPose[];
  [more: string]: any;
}

/** From the plane to pixels. */
export interface View {
  scale: number;
  left: number;
  top: number;
  width: number;
  height: number;
  X(x: number): number;
  Y(y: number): number;
}

/** What a page asks over its websocket; `burmester.studio.session` has the same, and a test compares them. */
export interface Asked {
  do: "follow" | "place" | "curve" | "cognates" | "solve" | "cancel" | "balance" | "six_bars" | "function" | "stop";
  [more: string]: any;
}

/** What a page is told there. */
export interface Told {
  n: number;
  kind:
    | "solving" | "waiting" | "progress" | "solved" | "limit" | "ended" | "cancelled" | "superseded" | "refused"
    | "followed" | "placed" | "curve" | "cognates" | "looked";
  [more: string]: any;
}
