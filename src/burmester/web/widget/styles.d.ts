// Style sheets are bundled as texts.

declare module "*.css";
