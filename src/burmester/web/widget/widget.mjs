// The report as a widget, in anywidget's module format: `render({ model, el })` fills the element
// and returns what takes it away again; model.get("data") is what `burmester.web.data.report_data`
// makes.  Nothing else is needed, and nothing is loaded.  Angles are radians unless a name says
// degrees; lengths are in the task's unit; F is the ground, M the body.

import { Report } from "./report.mjs";

const widget = {
  render({ model, el }) {
    const options = { webgl: model.get("webgl") ?? true };
    const made = (data) => new Report(data, el, options);
    let report = made(model.get("data"));
    const anew = () => {
      report.close();
      report = made(model.get("data"));
    };
    model.on?.("change:data", anew);
    return () => {
      model.off?.("change:data", anew);
      report.close();
    };
  },
};

export { widget as default };
