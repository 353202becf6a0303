// What is loaded when it is first used: a bundle of its own.

export { Backdrop } from "./backdrop.mjs";
export { Dimensions } from "./dimensions.mjs";
export { FunctionPage } from "./function_page.mjs";
export { decode, encode } from "./link.mjs";
export { qrCode } from "./qr_code.mjs";
export { SpringSearch } from "./spring_search.mjs";
export { TransformPanel } from "./transform_panel.mjs";
