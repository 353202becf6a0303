// What the modules of the page hand each other, and what the server and its workers tell them.

/** Where the body is: the origin of M in F, its angle in radians, and the joints of links between joints. */
export interface Place {
  x: number;
  y: number;
  a: number;
  joints?: Record<string, number[]>;
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
  do: "follow" | "place" | "curve" | "cognates" | "solve" | "cancel";
  [more: string]: any;
}

/** What a page is told there. */
export interface Told {
  n: number;
  kind:
    | "solving" | "waiting" | "progress" | "solved" | "limit" | "ended" | "cancelled" | "superseded" | "refused"
    | "followed" | "placed" | "curve" | "cognates";
  [more: string]: any;
}
