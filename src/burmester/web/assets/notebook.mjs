// Made by scripts/bundle from src/burmester/web/notebook: change those files, not this one.
var studio_default=`/* The studio's page.  Colours and type are those of widget.css. */

body.bs { margin: 0; min-height: 100vh; }
@media (prefers-color-scheme: dark) { html { background: #121418; } }
.bs .bs-failed { max-width: 40rem; margin: 3rem auto; padding: 0 1rem; }
.bs h3, .bs h4 { margin: 0; font-weight: 650; }
.bs h3 { font-size: 0.92rem; }
.bs h4 { font-size: 0.84rem; color: var(--bm-muted); font-weight: 600; }
.bs [hidden] { display: none !important; }
.bs input, .bs select { font: inherit; font-size: 0.88rem; color: inherit; }

/* The window: a head, and beside the plane a panel on either side.  Nothing scrolls but panels. */
body.bs { height: 100vh; height: 100dvh; min-height: 0; overflow: hidden; }
.bs #studio { height: 100%; display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); }
.bs-skip { position: absolute; z-index: 60; left: 8px; top: -60px; background: var(--bm-panel); color: var(--bm-ink); padding: 8px 12px; border-radius: 6px; }
.bs-skip:focus { top: 8px; }
.bs-head { display: flex; gap: 8px; align-items: center; padding: 5px 10px; border-bottom: 1px solid var(--bm-line); background: var(--bm-panel); min-width: 0; \
}
.bm .bs-head h1 { font-size: 0.92rem; white-space: nowrap; padding-right: 4px; }
.bs-head .bs-task-name { width: 11rem; font-weight: 600; flex: 0 1 auto; }
.bs-head .bs-row { flex-wrap: nowrap; gap: 4px; }
.bs .bs-head .bm-button { white-space: nowrap; }
.bs [data-menu="export"] > summary { background: var(--bm-accent); border-color: var(--bm-accent); color: var(--bm-panel); font-weight: 600; }
.bs [data-menu="export"] > summary::after { color: inherit; }
.bs-unseen { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; white-space: nowrap; }
.bm .bs-status { flex: 1 1 6rem; min-width: 0; text-align: right; color: var(--bm-muted); font-size: 0.88rem; min-height: 1.5em; white-space: nowrap; overflow: \
hidden; text-overflow: ellipsis; }
.bs-row, .bs-tools { display: flex; flex-wrap: wrap; gap: 6px 10px; align-items: center; }
.bs .bm-button { min-height: 32px; padding: 3px 10px; font-size: 0.86rem; }
.bs .bm-button[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); box-shadow: inset 0 -3px 0 var(--bm-accent); }
.bs-tools .bm-button { min-height: 28px; padding: 1px 8px; font-size: 0.82rem; }

.bs-menu { position: relative; }
.bs-menu > summary { list-style: none; }
.bs-menu > summary::-webkit-details-marker { display: none; }
.bs-menu > summary::after { content: "▾"; color: var(--bm-muted); }
.bs-menu-list { position: absolute; z-index: 20; top: calc(100% + 4px); left: 0; min-width: 260px; max-width: min(440px, 86vw); max-height: 70vh; overflow: auto\
; display: grid; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 10px; padding: 5px; box-shadow: 0 8px 28px rgb(0 0 0 / 0.18); }
.bs-menu-list { overscroll-behavior: contain; }
.bm .bs-menu-heading { color: var(--bm-muted); font-size: 0.78rem; font-weight: 650; padding: 6px 10px 2px; }
.bs-menu .bs-exports { left: auto; right: 0; width: min(640px, calc(100vw - 16px)); max-width: none; max-height: calc(100dvh - 70px); gap: 8px; }
.bs-uses { display: grid; grid-template-columns: repeat(auto-fill, minmax(190px, 1fr)); gap: 2px 8px; align-items: start; }
.bs-uses > div { display: grid; }
.bs-exports .bs-section { padding: 4px 10px; border: 0; border-top: 1px solid var(--bm-line); }
.bs-menu-item { font: inherit; font-size: 0.88rem; color: inherit; background: none; border: 0; border-radius: 6px; padding: 6px 10px; text-align: left; cursor:\
 pointer; display: grid; }
.bs-menu-item:hover, .bs-menu-item:focus-visible { background: var(--bm-wash); }
.bs-menu-item b { font-weight: 600; }
.bs-menu-item span { color: var(--bm-muted); font-size: 0.8rem; }

.bs-banners { position: fixed; z-index: 30; left: 10px; bottom: 10px; width: min(272px, calc(100vw - 20px)); max-height: 46vh; overflow: auto; display: grid; ga\
p: 8px; }
.bs-banner { position: relative; box-shadow: 0 6px 24px rgb(0 0 0 / 0.16); background: var(--bm-panel); border: 1px solid var(--bm-line); border-left: 4px solid\
 var(--bm-accent); border-radius: 8px; padding: 8px 46px 8px 14px; display: grid; gap: 6px; overflow-wrap: anywhere; }
.bs-banner.bs-refused, .bs-banner.bs-limit, .bs-banner.bs-offline, .bs-banner.bs-expired { border-left-color: var(--bm-bad); }
.bm .bs-banner-title { font-weight: 600; }
.bm .bs-banner ul { list-style: none; display: grid; gap: 6px; }
.bs-where, .bs-why { color: var(--bm-muted); }
.bs-where { margin: 2px 0; font: 12px/1.4 ui-monospace, Menlo, Consolas, monospace; white-space: pre-wrap; overflow-wrap: anywhere; }
.bs .bs-banner .bs-close { position: absolute; top: 5px; right: 6px; border: 0; background: none; font: inherit; color: var(--bm-muted); width: 32px; height: 32\
px; cursor: pointer; border-radius: 6px; }
.bs .bs-banner .bs-close:hover { background: var(--bm-faint); }

.bs-main { display: grid; min-height: 0; grid-template: minmax(0, 1fr) auto / auto minmax(0, 1fr) auto; grid-template-areas: "left stage right" "left drawer rig\
ht"; }
.bs-side { position: relative; min-width: 0; min-height: 0; overflow: auto; overscroll-behavior: contain; scrollbar-width: thin; padding: 8px 12px 24px; backgro\
und: var(--bm-bg); scroll-padding-bottom: 24px; }
/* Messages stand under the panel. */
.bs-side-left { margin-bottom: var(--bs-banners, 0); grid-area: left; width: clamp(292px, 18vw, 460px); border-right: 1px solid var(--bm-line); }
.bs-side-right { grid-area: right; width: clamp(288px, 19vw, 620px); border-left: 1px solid var(--bm-line); }
.bs .bs-fold { position: absolute; top: 6px; right: 6px; z-index: 2; border: 0; background: none; color: var(--bm-muted); font: inherit; font-size: 0.82rem; min\
-width: 26px; min-height: 26px; border-radius: 6px; cursor: pointer; padding: 2px 4px; }
.bs-fold:hover { background: var(--bm-faint); }
.bs-fold-name { display: none; }
.bs-side.bs-folded { width: 34px; padding: 6px 3px; overflow: hidden; }
.bs-folded > :not(.bs-fold) { display: none; }
.bs .bs-folded > .bs-fold { position: static; display: grid; gap: 8px; justify-items: center; width: 100%; }
.bs-folded .bs-fold-name { display: block; writing-mode: vertical-rl; }
.bs-left { display: grid; gap: 6px; min-width: 0; grid-template-columns: minmax(0, 1fr); }
.bs .bm-card { padding: 12px 14px; }
.bs-stage { grid-area: stage; min-width: 0; min-height: 0; display: grid; grid-template: auto minmax(0, 1fr) auto / minmax(0, 1fr); background: var(--bm-panel);\
 }
.bs-bar { display: flex; gap: 4px; align-items: center; padding: 4px 8px; overflow-x: auto; scrollbar-width: none; border-bottom: 1px solid var(--bm-faint); }
.bs .bs-bar .bm-button { min-height: 28px; padding: 1px 9px; white-space: nowrap; flex: none; border-color: transparent; background: none; }
.bs .bs-bar .bm-button:hover { background: var(--bm-faint); }
.bs .bs-bar .bm-button[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); }
.bs-gap { flex: 1; }
.bs-canvas { position: relative; min-height: 0; min-width: 0; }
/* One line over the plane: nothing moves where it changes, and nothing is caught by it. */
.bm .bs-line { position: absolute; left: 34px; right: 34px; top: 5px; text-align: center; pointer-events: none; color: var(--bm-muted); font-size: 0.82rem; line\
-height: 1.35; text-shadow: 0 0 3px var(--bm-panel), 0 0 3px var(--bm-panel), 0 0 3px var(--bm-panel); }
#bs-player { min-width: 0; padding: 5px 10px 3px; border-top: 1px solid var(--bm-faint); }
.bs-sheets { display: none; }
.bs-drawer { grid-area: drawer; position: relative; min-width: 0; min-height: 0; display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); height: min\
(var(--bs-height), 62vh); border-top: 1px solid var(--bm-line); background: var(--bm-bg); }
.bs-drawer.bs-closed { height: auto; }
.bs-grip { position: absolute; left: 0; right: 0; top: -5px; height: 10px; cursor: ns-resize; touch-action: none; z-index: 3; }
.bs-grip::after { content: ""; position: absolute; left: 50%; top: 3px; width: 44px; height: 4px; margin-left: -22px; border-radius: 2px; background: var(--bm-l\
ine); }
.bs-grip:hover::after, .bs-grip:focus-visible::after { background: var(--bm-accent); }
.bs-tabs { display: flex; gap: 2px; overflow-x: auto; scrollbar-width: none; padding: 3px 8px; }
.bs-tab, .bs-sheet { font: inherit; font-size: 0.84rem; color: var(--bm-muted); background: none; border: 0; border-radius: 6px; min-height: 28px; padding: 2px \
10px; white-space: nowrap; cursor: pointer; flex: none; }
.bs-tab:hover, .bs-sheet:hover { background: var(--bm-faint); }
.bs-tab[aria-selected="true"], .bs .bs-sheet[aria-pressed="true"] { color: var(--bm-ink); font-weight: 650; box-shadow: inset 0 -2px 0 var(--bm-accent); border-\
radius: 6px 6px 0 0; }
.bs-drawer-panels { min-height: 0; overflow: auto; overscroll-behavior: contain; scrollbar-width: thin; }
.bs-closed .bs-drawer-panels { display: none; }
.bs-panel { padding: 6px 12px 12px; }
.bs .bs-panel > h2 { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; }
.bs-panel.bs-unwanted { display: none; }
#bs-results, #bs-player { min-width: 0; }
.bs-plane { height: 100%; overflow: hidden; background: var(--bm-panel); min-width: 0; }
.bs-scene { width: 100%; height: 100%; touch-action: none; user-select: none; -webkit-user-select: none; cursor: grab; }
.bs-scene.bs-grasped { cursor: grabbing; }
.bs-scene.bs-drawing { cursor: crosshair; }
.bs .bs-scene:focus-visible { outline-offset: -3px; }
.bs-grid-line { stroke: var(--bm-faint); fill: none; }
.bs-grid-axis { stroke: var(--bm-line); fill: none; }
.bm .bs-layer-grid text { fill: var(--bm-muted); font-size: 11px; }

.bs-hold { fill: transparent; r: 12px; }
.bs-origin, .bs-turn { cursor: move; }
.bs-turn { cursor: grab; }
.bs-drawing .bs-origin, .bs-drawing .bs-turn, .bs-drawing .bs-shape-area { cursor: crosshair; }
.bs-axes { fill: none; stroke: var(--bm-wanted); stroke-width: 1.7; pointer-events: none; }
.bs-dot { fill: var(--bm-panel); stroke: var(--bm-wanted); stroke-width: 2; }
.bs-tip { fill: var(--bm-panel); stroke: var(--bm-wanted); stroke-width: 1.5; }
.bs-exact .bs-dot { fill: var(--bm-wanted); }
.bs-point .bs-dot { fill: var(--bm-wanted); r: 4px; }
.bs-path { fill: none; stroke: var(--bm-wanted); stroke-width: 1.4; stroke-dasharray: 5 4; stroke-linejoin: round; pointer-events: none; opacity: 0.75; }
.bs-draft-path { fill: none; stroke-linejoin: round; stroke-linecap: round; }
.bs-path-panel { display: grid; gap: 6px; margin-top: 10px; padding-top: 8px; border-top: 1px solid var(--bm-line); }
.bs-path-panel[hidden] { display: none; }
.bs-path-panel h3 { margin: 0; }
.bs-cognates { display: grid; gap: 10px; grid-template-columns: repeat(auto-fit, minmax(min(100%, 230px), 1fr)); }
.bs-cognates[hidden] { display: none; }
.bs-origin:hover .bs-dot, .bs-turn:hover .bs-tip { stroke: var(--bm-accent); stroke-width: 2.6; }
.bs-pose.bs-selected .bs-axes, .bs-pose.bs-selected .bs-dot, .bs-pose.bs-selected .bs-tip { stroke: var(--bm-accent); }
.bs-pose.bs-selected .bs-axes { stroke-width: 2.2; }
.bs .bs-origin:focus-visible, .bs .bs-turn:focus-visible, .bs .bs-shape-area:focus-visible { outline: none; }
.bs-origin:focus-visible .bs-hold, .bs-turn:focus-visible .bs-hold { fill: var(--bm-accent); fill-opacity: 0.2; stroke: var(--bm-accent); stroke-width: 2; }
.bm .bs-pose-name { font-weight: 600; fill: var(--bm-muted); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; pointer-events: none; unicode-bidi\
: plaintext; }
.bs-layer-labels { pointer-events: none; }

.bs-ghost { fill: var(--bm-body); fill-opacity: 0.06; stroke: var(--bm-body); stroke-width: 1.1; stroke-linejoin: round; pointer-events: none; }
.bs-shape-line { fill: none; stroke: var(--bm-muted); stroke-width: 1.6; stroke-linejoin: round; pointer-events: none; }
.bs-shape-area { fill: transparent; stroke: transparent; stroke-width: 12; cursor: move; }
.bs-shape-area.bs-open { fill: none; stroke-width: 18; }
.bs-shape-area:focus-visible { stroke: var(--bm-accent); stroke-opacity: 0.3; }
.bs-shape:hover > .bs-shape-line, .bs-shape.bs-selected > .bs-shape-line { stroke-width: 2.6; }
.bs-body-shape > .bs-shape-line { stroke: var(--bm-body); stroke-width: 1.6; }
.bs-body-shape > .bs-shape-area { stroke-width: 8; }
.bs-body-shape:not(.bs-selected) > .bs-shape-area { fill: none; }
.bs-region > .bs-shape-line { stroke: var(--bm-muted); }
.bs-hatched { pointer-events: none; stroke: none; }
.bs-region > .bs-shape-area { fill: var(--bm-muted); fill-opacity: 0.08; }
.bs-limit > .bs-shape-line { stroke-dasharray: 7 4; }
.bs-limit.bs-moving-pivot > .bs-shape-line { stroke-dasharray: 2 4; stroke-linecap: round; }
.bs-limit > .bs-shape-area:not(.bs-open) { fill: none; }
.bs-limit.bs-selected > .bs-shape-area:not(.bs-open) { fill: var(--bm-accent); fill-opacity: 0.05; }
.bs-footprint > .bs-shape-line { stroke-dasharray: 12 3 2 3; }
.bs-footprint > .bs-shape-area { fill: none; }
.bs-met > .bs-shape-line { stroke: var(--bm-good); }
.bs-broken > .bs-shape-line { stroke: var(--bm-bad); stroke-width: 2.6; }
.bs-corner { fill: var(--bm-panel); stroke: var(--bm-accent); stroke-width: 2; cursor: move; }
.bs-middle { fill: var(--bm-accent); fill-opacity: 0.45; cursor: copy; }
.bs .bs-corner:focus-visible { outline: none; fill: var(--bm-accent); }
.bs-draft { fill: var(--bm-accent); fill-opacity: 0.08; stroke: var(--bm-accent); stroke-width: 2; pointer-events: none; }
.bs-draft-dot { fill: var(--bm-accent); pointer-events: none; }
.bs-first { fill: var(--bm-panel); stroke: var(--bm-accent); stroke-width: 2; }
.bm .bs-region-name, .bm .bs-limit-name { font-size: 11.5px; fill: var(--bm-muted); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; unicode-bid\
i: plaintext; }
.bm .bs-region-name { font-weight: 600; }

.bs-table-box, .bs-task { display: grid; gap: 8px; min-width: 0; grid-template-columns: minmax(0, 1fr); }
.bs-poses { border-collapse: collapse; width: 100%; font-size: 0.88rem; margin-top: 6px; table-layout: fixed; }
.bs-poses th { text-align: left; font-weight: 600; color: var(--bm-muted); font-size: 0.8rem; padding: 0 3px 2px; }
.bs-poses th:first-child { width: 28px; }
.bs-poses th:nth-child(2) { width: 22%; }
.bs-poses .bs-number { padding: 2px 3px; font-size: 0.82rem; }
.bs-poses th:nth-child(n + 3) { text-align: right; padding-right: 6px; }
.bs-poses td { padding: 1px; vertical-align: top; }
.bs-poses tbody th { padding: 1px 2px; vertical-align: top; }
.bs-pose-row.bs-selected { background: var(--bm-wash); }
.bs-index { font: inherit; font-size: 0.82rem; width: 100%; min-height: 28px; color: var(--bm-muted); background: none; border: 1px solid transparent; border-ra\
dius: 6px; cursor: pointer; padding: 0; }
.bs-index:hover { border-color: var(--bm-line); }
.bs-index[aria-pressed="true"] { color: var(--bm-accent); font-weight: 700; }
.bs-field { display: inline-grid; min-width: 0; width: 100%; }
.bs-number, .bs-text { width: 100%; min-width: 0; min-height: 28px; padding: 2px 6px; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radi\
us: 6px; }
.bs .bs-number { text-align: right; }
.bs-poses .bs-number, .bs-poses .bs-text { border-color: transparent; background: none; }
.bs-poses tr:hover .bs-number, .bs-poses tr:hover .bs-text, .bs-poses tr.bs-selected .bs-number, .bs-poses tr.bs-selected .bs-text { border-color: var(--bm-line\
); }
.bs input:disabled { opacity: 0.45; }
.bs .bs-number[aria-invalid="true"] { border-color: var(--bm-bad); background: color-mix(in srgb, var(--bm-bad) 10%, transparent); }
.bm .bs-fault { color: var(--bm-bad); font-size: 0.78rem; line-height: 1.3; padding: 2px 0 4px; overflow-wrap: anywhere; }
.bs-poses td:has(.bs-fault:not([hidden])) { overflow: visible; }
.bs-unit, .bs-hint, .bs-label { color: var(--bm-muted); font-size: 0.82rem; }
.bs-pages { display: flex; gap: 8px; align-items: center; font-size: 0.85rem; }
.bs-details { border-top: 1px solid var(--bm-line); padding-top: 8px; display: grid; gap: 7px; }
.bs-tolerances { border-collapse: collapse; font-size: 0.86rem; }
.bs-tolerances caption { text-align: left; color: var(--bm-muted); font-size: 0.82rem; padding-bottom: 3px; }
.bs-tolerances th { text-align: left; font-weight: 500; padding: 1px 8px 1px 0; width: 4.4em; }
.bs-tolerances td { padding: 1px 8px 1px 0; }
.bs-tolerances .bs-field { width: 6.5em; }
.bs-tick { display: inline-flex; gap: 6px; align-items: center; font-size: 0.86rem; cursor: pointer; min-height: 26px; }
.bs-tick input { accent-color: var(--bm-accent); margin: 0; flex: none; }
.bs-labelled { display: inline-flex; gap: 6px; align-items: center; flex-wrap: wrap; }
.bs-labelled .bs-field { width: 6.4em; }
.bs-choice { background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; padding: 3px 6px; max-width: 100%; min-height: 28px; }
.bs-task + .bs-task { margin-top: 8px; }
.bs-section { border-bottom: 1px solid var(--bm-faint); padding-bottom: 6px; display: block; }
.bs-section > summary, .bs-section details > summary { cursor: pointer; }
.bs-section > summary { font-weight: 650; padding: 4px 0; }
.bs-section details > summary { color: var(--bm-accent); font-size: 0.84rem; }
.bs-section > :not(summary) { margin-top: 6px; }
.bs-grid { display: grid; gap: 6px; }
.bs-grid .bs-labelled { justify-content: flex-start; flex-wrap: nowrap; }
.bs-grid .bs-choice { flex: 0 1 11em; min-width: 0; }
.bs-grid .bs-label { flex: 1 1 8em; }
.bs-grid .bs-labelled .bs-field { width: 6.4em; flex: none; }
.bs-grid .bs-labelled .bs-hint { flex: none; width: 1em; }
.bs-pair { display: inline-flex; gap: 4px; }
.bs-grid .bs-labelled .bs-pair .bs-field { width: 4.4em; }
.bs-limit-table, .bs-limit-box { display: grid; gap: 5px; min-width: 0; }
.bs-limit-table + .bs-limit-table { margin-top: 14px; }
.bs-limit-box { border-left: 2px solid var(--bm-line); padding: 2px 0 4px 9px; margin: 4px 0; justify-items: start; }
.bs-limit-box.bs-selected { border-left-color: var(--bm-accent); }
.bs-limit-box .bs-text { width: 12em; }
.bs-point-fields, .bs-coordinates { display: grid; gap: 3px; }
.bs-pair { display: grid; grid-template-columns: 6em 6em; gap: 5px; }
.bs-ticks { display: grid; grid-template-columns: repeat(auto-fill, minmax(10em, 1fr)); }
.bm .bs-state { font-size: 0.82rem; color: var(--bm-muted); }
.bm .bs-state.bs-met { color: var(--bm-good); }
.bm .bs-state.bs-broken { color: var(--bm-bad); }

.bs-dropping { position: fixed; inset: 0; z-index: 50; display: grid; place-items: center; background: color-mix(in srgb, var(--bm-bg) 82%, transparent); border\
: 4px dashed var(--bm-accent); font-size: 1.2rem; font-weight: 600; pointer-events: none; }
.bs-dialog { background: var(--bm-panel); color: var(--bm-ink); border: 1px solid var(--bm-line); border-radius: 12px; padding: 18px 20px; max-width: min(760px,\
 92vw); max-height: 86vh; overflow: auto; }
.bs-dialog::backdrop { background: rgb(0 0 0 / 0.45); }
.bs-keys { display: grid; gap: 5px; padding: 10px 0; }
.bs-keys div { display: grid; grid-template-columns: minmax(6rem, 11rem) 1fr; gap: 12px; }
.bs-keys dt { font-weight: 600; }
.bs-command { display: grid; gap: 4px; padding: 8px 0; justify-items: start; }
.bs-command pre { margin: 0; width: 100%; overflow-x: auto; background: var(--bm-faint); border-radius: 6px; padding: 8px 10px; font: 13px/1.45 ui-monospace, "S\
F Mono", Menlo, Consolas, monospace; white-space: pre-wrap; overflow-wrap: anywhere; }

@media (pointer: coarse) {
  .bs .bm-button, .bs-number, .bs-text, .bs-choice, .bs-tick, .bs-index { min-height: 40px; }
  .bs-tools .bm-button { min-height: 38px; padding: 3px 12px; }
  .bs-hold { r: 22px; }
  .bs-corner { r: 9px; }
  .bs-middle { r: 8px; }
}
@media (max-width: 1179px) {
  .bs-main { grid-template: minmax(0, 1fr) auto / minmax(0, 1fr) auto; grid-template-areas: "stage side" "drawer side"; }
  .bs-sheets { display: flex; grid-area: side; align-self: start; gap: 2px; padding: 4px 8px; background: var(--bm-bg); border-left: 1px solid var(--bm-line); z\
-index: 4; }
  .bs-sheets [data-sheet-of="drawer"], .bs-side .bs-fold { display: none; }
  .bs-side, .bs-side.bs-folded { grid-area: side; width: 318px; padding: 40px 12px 24px; border: 0; border-left: 1px solid var(--bm-line); overflow: auto; }
  .bs-folded > :not(.bs-fold) { display: grid; }
  .bs-side.bs-below { display: none; }
  .bs-banners { left: auto; right: 10px; width: min(298px, calc(100vw - 20px)); }
  .bs-side { margin-bottom: var(--bs-banners, 0); }
}
@media (max-width: 759px) {
  .bm .bs-head h1 { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; }
  .bs-head { padding: 4px 6px; gap: 5px; }
  .bs-head .bs-task-name { flex: 1 1 5rem; width: 5rem; }
  .bm .bs-status { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; }
  .bs-main { grid-template: minmax(0, 1fr) auto min(var(--bs-sheet, 36vh), 60vh) / minmax(0, 1fr); grid-template-areas: "stage" "sheets" "side"; }
  .bs-sheets { grid-area: sheets; border: 0; border-top: 1px solid var(--bm-line); }
  .bs-sheets [data-sheet-of="drawer"] { display: block; }
  .bs-side, .bs-side.bs-folded { width: auto; border: 0; padding: 8px 12px 24px; }
  .bs-drawer, .bs-drawer.bs-closed { grid-area: side; height: auto; border: 0; }
  .bs-drawer.bs-below, .bs-grip { display: none; }
  .bm .bs-line { left: 8px; right: 8px; top: 3px; font-size: 0.74rem; }
  .bs-bar { padding: 2px 4px; }
}
@media print {
  body.bs { height: auto; overflow: visible; }
  .bs-skip, .bs-head > :not(h1, .bs-task-name), .bs-banners, .bs-bar, .bs-line, .bs-tools, .bs-tabs, .bs-sheets, .bs-grip, .bs-fold, .bs-details, .bs .bm-button\
, .bs-section:not([open]) { display: none !important; }
  .bs #studio, .bs-main, .bs-stage, .bs-drawer, .bs-drawer-panels { display: block !important; height: auto !important; overflow: visible; }
  .bs .bs-side { display: block; width: auto; overflow: visible; border: 0; padding: 0; }
  .bs-folded > :not(.bs-fold) { display: grid; }
  .bs-main > *, .bs .bm-card { margin-bottom: 8mm; }
  .bs-stage, .bs-card, .bs-panel:not(.bs-panel-facts) { break-inside: avoid; }
  .bs-panel > h2 { position: static !important; clip-path: none !important; width: auto !important; height: auto !important; }
  .bs-plane { height: 110mm; }
  .bs-hold, .bs-corner, .bs-middle { display: none; }
}

/* What shows answers */

.bs-quiet, .bs-card-note, .bs-help { color: var(--bm-muted); font-size: 0.82rem; overflow-wrap: anywhere; }
.bs-small { font: inherit; font-size: 0.8rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; min-height: 26p\
x; padding: 1px 9px; cursor: pointer; }
.bs-small:hover { border-color: var(--bm-muted); }
.bs-small[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); }
.bs-tool { display: flex; flex-wrap: wrap; gap: 4px 10px; align-items: center; font-size: 0.86rem; margin-top: 6px; }
.bs-tool label { display: inline-flex; gap: 6px; align-items: center; cursor: pointer; min-height: 26px; }
.bs-tool input { accent-color: var(--bm-accent); margin: 0; }
.bm .bs-points { list-style: none; width: 100%; display: grid; gap: 4px; }

.bs-results { display: grid; gap: 10px; grid-template-columns: minmax(0, 1fr); }
.bs-results-head { display: grid; gap: 4px; }
.bm .bs-results-status, .bm .bs-doubt, .bm .bs-gone-note { font-size: 0.84rem; color: var(--bm-muted); overflow-wrap: anywhere; }
.bm .bs-results-status { min-height: 1.5em; }
.bm .bs-doubt:empty, .bm .bs-gone-note:empty { display: none; }
.bm .bs-doubt { color: var(--bm-bad); }
.bs-choices { display: flex; flex-wrap: wrap; gap: 4px 10px; font-size: 0.82rem; color: var(--bm-muted); }
.bs-choices select { background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; padding: 2px 4px; font-size: 0.82rem; max-width: 9.5em; \
}
.bs-cards { display: grid; gap: 8px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 240px), 1fr)); align-items: start; }
.bs-card.bm-choice { padding: 0; cursor: default; gap: 0; flex: none; }
.bs-card.bs-chosen { border-color: var(--bm-accent); background: var(--bm-wash); box-shadow: inset 4px 0 0 var(--bm-accent); }
.bs-card-main { font: inherit; color: inherit; text-align: left; background: none; border: 0; padding: 9px 12px 4px; cursor: pointer; display: grid; gap: 2px; b\
order-radius: 10px; min-width: 0; }
.bs-card-main > span:empty { display: none; }
.bs .bs-card .bm-reason:not(:empty) { display: block; }
.bs-was { color: var(--bm-muted); font-size: 0.78rem; font-weight: 400; }
.bs-figures { font-size: 0.84rem; }
.bs-card-tools { display: flex; flex-wrap: wrap; gap: 5px; padding: 2px 12px 9px; }
.bs-help { border-left: 3px solid var(--bm-accent); padding-left: 7px; }
.bm .bs-better { padding: 0 12px 9px 28px; font-size: 0.82rem; color: var(--bm-muted); }
.bm .bs-better:empty { display: none; }
.bs-old [data-figure="size"], .bs-old [data-figure="sensitivity"], .bs-old .bs-help, tr.bs-old, .bs-facts section.bs-old, .bs-stale .bm-map { opacity: 0.45; }
.bs-card.bs-gone { border-style: dashed; }
.bs-card.bs-gone .bs-figures { opacity: 0.45; }

#bs-player .bm-controls { grid-template: auto auto / auto minmax(0, 1fr); gap: 0 12px; margin: 0; align-items: start; }
#bs-player .bm-row { grid-area: 1 / 1; gap: 5px; flex-wrap: nowrap; }
#bs-player .bm-track { grid-area: 1 / 2; padding-top: 4px; }
#bs-player .bm-now { grid-column: 1 / -1; font-size: 0.82rem; color: var(--bm-muted); white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
.bs #bs-player .bm-button { min-height: 30px; padding: 1px 9px; font-size: 0.84rem; white-space: nowrap; }
.bs #bs-player .bm-play { min-width: 76px; background: var(--bm-panel); color: var(--bm-accent); border-color: var(--bm-accent); }
#bs-player .bm-whole { font-size: 0.82rem; min-height: 30px; }
.bs-player.bs-empty .bm-controls { display: none; }
.bs-player-ways { display: flex; flex-wrap: wrap; gap: 2px 22px; }
.bm .bs-player-ways .bm-ways { margin-bottom: 2px; }
.bs-player-tools { display: flex; flex-wrap: wrap; gap: 0 22px; }
.bm .bs-driver-note:empty { display: none; }
.bs-paths, .bs-mechanism, .bs-dyad-names, .bs-centrodes, .bs-burmester, .bs-coupler-curves { pointer-events: none; }
.bs-centrode { fill: none; stroke-width: 1.6; }
.bs-fixed-centrode { stroke: var(--bm-error); }
.bs-moving-centrode { stroke: var(--bm-error); stroke-dasharray: 5 4; }
.bs-instant-centre circle { fill: none; stroke: var(--bm-error); stroke-width: 2; }
.bs-instant-centre path, .bs-rays { fill: none; stroke: var(--bm-error); stroke-width: 1; opacity: 0.7; }
.bs-rays { stroke-dasharray: 2 4; }
.bs-coupler-curve { stroke: var(--bm-accent); stroke-width: 1.8; }
.bs-coupler-dot { fill: var(--bm-accent); stroke: var(--bm-panel); stroke-width: 1.5; }
.bs-pivot, .bs-coupler-point { cursor: move; }
.bs-drawing .bs-pivot, .bs-drawing .bs-coupler-point { pointer-events: none; }
.bs-pivot-ring { fill: none; stroke: var(--bm-muted); stroke-width: 1.2; stroke-dasharray: 2 2.5; }
.bs-pivot:hover .bs-pivot-ring { stroke: var(--bm-accent); stroke-width: 2; stroke-dasharray: none; }
.bs-pivot.bs-put .bs-pivot-ring { stroke: var(--bm-accent); stroke-width: 2.4; stroke-dasharray: none; }
.bs .bs-pivot:focus-visible, .bs .bs-coupler-point:focus-visible { outline: none; }
.bs-pivot:focus-visible .bs-hold, .bs-coupler-point:focus-visible .bs-hold { fill: var(--bm-accent); fill-opacity: 0.2; stroke: var(--bm-accent); stroke-width: \
2; }
.bs-map-pivot { pointer-events: none; }
.bs-map-pivot .bs-pivot-ring { fill: var(--bm-panel); fill-opacity: 0.6; stroke: var(--bm-ink); stroke-width: 2.4; stroke-dasharray: none; }
.bs-curve { fill: none; stroke-width: 2.4; }
.bs-curve-M { stroke-dasharray: 5 4; }
.bs-curve-plain { stroke: var(--bm-muted); }
.bs-curve-works { stroke: var(--bm-good); }
.bs-curve-outside { stroke: var(--bm-pair-outside); }
.bs-curve-fails { stroke: var(--bm-bad); opacity: 0.55; stroke-width: 1.6; }
.bs-key-works, .bs-key-outside, .bs-key-fails { display: inline-block; width: 18px; height: 4px; border-radius: 2px; vertical-align: 3px; background: var(--bm-g\
ood); }
.bs-key-outside { background: var(--bm-pair-outside); }
.bs-key-fails { background: var(--bm-bad); }
.bs-placed-readout { display: block; font-size: 0.86rem; margin-top: 4px; overflow-wrap: anywhere; }
.bs-placed-readout:empty { display: none; }

.bs-panel .bs-surface .bm-map svg { touch-action: none; }
.bs-beside { display: grid; gap: 12px; grid-template-columns: repeat(auto-fit, minmax(min(100%, 280px), 1fr)); }
.bm .bs-compared { table-layout: fixed; }
.bm .bs-compared th { white-space: normal; }
.bm .bs-compared th, .bm .bs-compared td { text-align: left; }
.bs-facts { display: grid; gap: 16px; grid-template-columns: minmax(0, 1fr); }
.bs-facts caption { position: static; width: auto; height: auto; clip-path: none; text-align: left; color: var(--bm-muted); padding: 2px 0; }
@media (max-width: 759px) {
  #bs-player .bm-controls { grid-template: auto auto auto / minmax(0, 1fr); }
  #bs-player .bm-track { grid-area: 2 / 1; }
  #bs-player .bm-now { white-space: normal; max-height: 2.8em; font-size: 0.76rem; line-height: 1.35; }
  .bs-cards { grid-template-columns: repeat(auto-fill, minmax(min(100%, 220px), 1fr)); }
}
@media (pointer: coarse) { .bs-small { min-height: 38px; padding: 3px 12px; } }
@media print {
  .bs-card-tools, .bs-choices, .bs-tool, .bs-results-status, .bs-pivots, .bs-player .bm-row, .bs-player .bm-track { display: none !important; }
  .bs-panel { break-inside: avoid; margin-bottom: 6mm; }
  .bs-panel-compare:has(.bs-compare > div[hidden]) { display: none; } /* nothing is compared */
  .bs-compare .bm-plane { height: auto; }
  .bs-panel .bm-map { width: 120mm; } /* and the image space fits below it */
  .bs-facts .bm-linkages { font-size: 7pt; }
  .bm-near, .bm-far, [class^="bs-key-"] { print-color-adjust: exact; } /* keys to what is drawn */
}
/* What changes under a hand is laid out by itself. */
@media screen {
  .bs-plane { contain: strict; }
  .bs-left > .bs-section, .bs-card, .bs-panel, #bs-player, #bs-results { contain: layout style; }
}
/* What a hand has on the plane: what it snaps to, numbers beside a handle, a box that selects, the pose that is drawn at. */
.bs-plane { position: relative; }
.bs-snap { pointer-events: none; }
.bs-snap-mark { fill: none; stroke: var(--bm-error); stroke-width: 1.5; }
.bm .bs-snap-name { font-size: 11.5px; fill: var(--bm-error); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; unicode-bidi: plaintext; }
.bs-marquee { fill: var(--bm-accent); fill-opacity: 0.08; stroke: var(--bm-accent); stroke-dasharray: 4 3; pointer-events: none; }
.bs-handle-field { position: absolute; z-index: 3; display: flex; gap: 6px; padding: 4px 6px; background: var(--bm-panel); border: 1px solid var(--bm-line); bor\
der-radius: 8px; box-shadow: 0 3px 12px rgb(0 0 0 / 0.16); }
.bs-handle-field[hidden] { display: none; }
.bs-handle-field label { display: flex; align-items: baseline; gap: 3px; color: var(--bm-muted); font-size: 0.78rem; white-space: nowrap; }
.bs-handle-field .bs-number { width: 5.4em; }
.bs-on-body .bs-pose:not(.bs-reference), .bs-on-body .bs-pose-name:not(.bs-reference), .bs-on-body .bs-ghost:not(.bs-reference) { opacity: 0.3; }
.bs-on-body .bs-pose.bs-reference .bs-axes { stroke: var(--bm-accent); stroke-width: 2.6; }
.bm .bs-on-body .bs-pose-name.bs-reference { fill: var(--bm-accent); }
.bs-dimension-line { fill: none; stroke: var(--bm-muted); pointer-events: none; }
.bm .bs-dimension { font-size: 12px; fill: var(--bm-ink); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm .bs-dimension[role] { pointer-events: auto; cursor: pointer; fill: var(--bm-accent); }
.bs-quiet-line { display: flex; gap: 8px; align-items: baseline; color: var(--bm-muted); font-size: 0.84rem; padding: 2px 4px; }
`;var widget_default=`.bm {
  --bm-bg: #f6f6f3; --bm-panel: #ffffff; --bm-ink: #1a1e25; --bm-muted: #5c6470; --bm-line: #dfe1dd; --bm-faint: #eeefec;
  --bm-driver: #1b5cb8; --bm-follower: #a84a12; --bm-coupler: #4a5869; --bm-plate: #d5dce4;
  --bm-driver-solid: #5b93dd; --bm-follower-solid: #e09b62;
  --bm-wanted: #6c7580; --bm-error: #b0125f; --bm-good: #196b3c; --bm-bad: #9c3118; --bm-accent: #1b5cb8; --bm-wash: #eaf1fb;
  --bm-map-near: #5d9c8f; --bm-map-far: #f7f6ee; --bm-body: #1c7a6c; --bm-spring: #6b43ab; --bm-hand: #9a5a00;
  --bm-pair-low: #123570; --bm-pair-middle: #7b7b78; --bm-pair-high: #fde737;
  --bm-pair-outside: #9fb4c7; --bm-pair-order: #d9bfa3; --bm-pair-branch: #dfe2e6; --bm-pair-circuit: #f6f6f4;
  container-type: inline-size; background: var(--bm-bg); color: var(--bm-ink); font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sa\
ns-serif; min-height: 100vh;
  font-variant-numeric: tabular-nums;
}
@media (prefers-color-scheme: dark) {
  .bm {
    --bm-bg: #121418; --bm-panel: #1a1d23; --bm-ink: #e8eaed; --bm-muted: #a0a8b4; --bm-line: #30353e; --bm-faint: #22262d;
    --bm-driver: #79aefa; --bm-follower: #eda469; --bm-coupler: #b6c1cf; --bm-plate: #353e4a;
    --bm-driver-solid: #4d86d2; --bm-follower-solid: #cd8548;
    --bm-wanted: #98a2af; --bm-error: #ff7db9; --bm-good: #63cb90; --bm-bad: #ff9277; --bm-accent: #79aefa; --bm-wash: #1f2a3b;
    --bm-map-near: #4f9c8c; --bm-map-far: #1d2128; --bm-body: #55c4b0; --bm-spring: #b795ef; --bm-hand: #f0b04a;
    --bm-pair-low: #3f74d8; --bm-pair-middle: #a39f92; --bm-pair-high: #fde737;
    --bm-pair-outside: #46586a; --bm-pair-order: #6a5644; --bm-pair-branch: #30363f; --bm-pair-circuit: #1f232a;
  }
}
.bm *, .bm *::before { box-sizing: border-box; }
.bm h1, .bm h2, .bm p, .bm dl, .bm dd, .bm ul, .bm fieldset { margin: 0; padding: 0; }
.bm h1 { font-size: 1.3rem; line-height: 1.2; font-weight: 650; letter-spacing: -0.01em; overflow-wrap: anywhere; }
.bm h2 { font-size: 0.98rem; line-height: 1.35; font-weight: 650; }
.bm :focus { outline: none; }
.bm :focus-visible { outline: 2.5px solid var(--bm-accent); outline-offset: 2px; border-radius: 4px; }

.bm-head { max-width: 1760px; margin: 0 auto; padding: clamp(12px, 1.4cqw, 20px) clamp(14px, 2.4cqw, 36px) 2px; display: grid; gap: 4px; }
.bm .bm-overline { color: var(--bm-muted); font-size: 0.78rem; letter-spacing: 0.04em; }
.bm-outcome { display: flex; gap: 9px; align-items: baseline; font-size: 1.08rem; max-width: 80rem; }
.bm-sign { flex: none; width: 1.45em; height: 1.45em; border-radius: 50%; display: inline-grid; place-items: center; font-size: 0.8em; font-weight: 700; color: \
var(--bm-panel); background: currentColor; }
.bm-outcome.bm-good .bm-sign { background: var(--bm-good); }
.bm-outcome.bm-bad .bm-sign { background: var(--bm-bad); }
.bm-outcome.bm-open .bm-sign { background: var(--bm-accent); }
.bm-code { font-size: 0.78em; color: var(--bm-muted); border: 1px solid var(--bm-line); border-radius: 4px; padding: 0 5px; white-space: nowrap; }
.bm-best, .bm-why { max-width: 68rem; }
.bm-best { color: var(--bm-ink); }
.bm-why { color: var(--bm-muted); overflow-wrap: anywhere; }
.bm-why b { font-weight: 600; color: var(--bm-ink); }
.bm-about summary { cursor: pointer; color: var(--bm-accent); font-size: 0.9rem; width: fit-content; }
.bm-about[open] { display: grid; gap: 4px; padding-bottom: 8px; }
.bm-found { max-width: 68rem; overflow-wrap: anywhere; }
.bm .bm-warnings { list-style: none; display: grid; gap: 8px; margin-top: 6px; }
.bm-warnings li { border-left: 3px solid var(--bm-follower); padding: 2px 0 2px 12px; max-width: 68rem; }

.bm-body { max-width: 1760px; margin: 0 auto; padding: 12px clamp(14px, 2.4cqw, 36px) 24px; display: grid; gap: 16px; grid-template-columns: minmax(0, 1fr); }
.bm-main { display: grid; gap: 16px; grid-template-columns: minmax(0, 1fr); min-width: 0; align-content: start; }
.bm-card { background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 10px; padding: 14px 16px 16px; min-width: 0; }
.bm-story { color: var(--bm-muted); font-size: 0.9rem; margin-top: 2px; }
.bm .bm-card > .bm-story { margin: 2px 0 8px; }
.bm .bm-stage > .bm-story { min-height: 1.5em; }
.bm .bm-stage > .bm-drawing { margin-bottom: 10px; }
.bm-fill { margin-top: 8px; min-width: 0; }

.bm-list > h2 { padding: 0 2px 8px; }
.bm-choices { display: flex; align-items: flex-start; gap: 10px; overflow-x: auto; padding: 3px 3px 10px; margin: -3px; scroll-snap-type: x proximity; scrollbar\
-width: thin; }
.bm-choice { flex: 0 0 250px; scroll-snap-align: start; display: flex; flex-direction: column; gap: 3px; text-align: left; font: inherit; font-size: 0.86rem; co\
lor: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 10px; padding: 10px 12px; cursor: pointer; }
.bm-choice:hover { border-color: var(--bm-muted); }
.bm-choice[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); box-shadow: inset 4px 0 0 var(--bm-accent); }
.bm-choice-head { font-size: 1rem; }
.bm-choice-head b { font-weight: 700; }
.bm-verdict { font-weight: 600; }
.bm-quiet { color: var(--bm-muted); font-size: 0.78rem; }
.bm-good .bm-verdict { color: var(--bm-good); }
.bm-bad .bm-verdict { color: var(--bm-bad); }
.bm-choice dl { display: grid; grid-template-columns: auto 1fr; gap: 0 10px; }
.bm-choice dd.bm-links { display: flex; flex-wrap: wrap; justify-content: flex-end; gap: 0 6px; font-size: 0.82rem; line-height: 1.6; }
.bm-choice dt { color: var(--bm-muted); }
.bm-choice dd { text-align: right; }
.bm-whole-word { display: inline-block; white-space: pre; }
.bm-reason, .bm-story, .bm-outcome, .bm-best, .bm-now { overflow-wrap: anywhere; }
.bm-reason { color: var(--bm-muted); font-size: 0.82rem; line-height: 1.38; border-top: 1px solid var(--bm-line); padding-top: 5px; margin-top: 3px; }

.bm .bm-ways { border: 0; display: flex; flex-wrap: wrap; gap: 6px 8px; margin: 0 0 8px; align-items: center; font-size: 0.86rem; }
.bm-ways legend { float: left; padding: 0; margin-right: 6px; color: var(--bm-muted); line-height: 30px; }
.bm-ways label { position: relative; display: inline-flex; align-items: center; gap: 7px; border: 1px solid var(--bm-line); border-radius: 8px; padding: 4px 11p\
x 4px 9px; cursor: pointer; }
.bm-ways label:has(:checked) { border-color: var(--bm-accent); background: var(--bm-wash); }
.bm-ways label:has(:focus-visible) { outline: 2.5px solid var(--bm-accent); outline-offset: 2px; }
.bm-ways input { margin: 0; accent-color: var(--bm-accent); outline: none; flex: none; }
.bm-ways b { font-weight: 600; }
.bm-ways b::first-letter { text-transform: uppercase; }

.bm svg { display: block; max-width: 100%; }
.bm text { font: 12px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; fill: var(--bm-ink); font-variant-numeric: tabular-nums; }
.bm-drawing { border: 1px solid var(--bm-faint); border-radius: 8px; overflow: hidden; }
.bm-plane { width: 100%; touch-action: pan-y; }
.bm .bm-plane:focus-visible, .bm .bm-space:focus-visible, .bm .bm-scroll:focus-visible { outline-offset: -3px; border-radius: 8px; }
.bm-grid path { stroke: var(--bm-faint); fill: none; }
.bm .bm-grid text { fill: var(--bm-muted); font-size: 11px; }
.bm-ghost { fill: var(--bm-body); fill-opacity: 0.06; stroke: var(--bm-body); stroke-width: 1.1; stroke-linejoin: round; }
.bm-body-outline { fill: var(--bm-body); fill-opacity: 0.2; stroke: var(--bm-body); stroke-width: 2; stroke-linejoin: round; }
.bm-hatch { fill: none; stroke: var(--bm-muted); stroke-width: 1.1; }
.bm-region-plain { fill: var(--bm-muted); fill-opacity: 0.1; }
.bm-region-edge { stroke: var(--bm-muted); stroke-width: 1.5; stroke-linejoin: round; }
.bm .bm-region-name { font-weight: 600; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 4px; }
.bm-curve { fill: none; stroke: var(--bm-coupler); stroke-width: 1.6; }
.bm-curve.bm-beyond { stroke-width: 1; opacity: 0.5; }
.bm-curve.bm-same { stroke-dasharray: 6 4; opacity: 0.7; }
.bm-curve.bm-other { stroke-dasharray: 1.5 4; opacity: 0.75; }
.bm-pivot-path { fill: none; stroke-width: 1; opacity: 0.42; }
.bm-pivot-path.bm-side0 { stroke: var(--bm-driver); }
.bm-pivot-path.bm-side1 { stroke: var(--bm-follower); }
.bm-pivot-path.bm-side-inner { stroke: var(--bm-coupler); }
.bm-solid { fill: var(--bm-panel); stroke: var(--bm-coupler); stroke-width: 1.5; stroke-linejoin: round; }
.bm-ground { stroke: var(--bm-coupler); stroke-width: 1.4; fill: none; }
.bm-thin { opacity: 0.55; }
.bm .bm-name { font-weight: 600; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm text.bm-side0, .bm b.bm-side0, .bm th.bm-side0 { fill: var(--bm-driver); color: var(--bm-driver); }
.bm text.bm-side1, .bm b.bm-side1, .bm th.bm-side1 { fill: var(--bm-follower); color: var(--bm-follower); }
.bm-wanted path { fill: none; stroke: var(--bm-wanted); stroke-width: 1.3; stroke-dasharray: 3.5 2.5; }
.bm-wanted circle { fill: none; stroke: var(--bm-wanted); stroke-width: 1.4; }
.bm-wanted-path { fill: none; stroke: var(--bm-wanted); stroke-width: 1.2; stroke-dasharray: 5 4; stroke-linejoin: round; opacity: 0.75; }
.bm-achieved path { fill: none; stroke: var(--bm-ink); stroke-width: 1.1; }
.bm-achieved circle { fill: var(--bm-ink); }
.bm-elsewhere { opacity: 0.38; }
.bm-errors path { fill: none; stroke: var(--bm-error); stroke-width: 1.8; stroke-linejoin: round; stroke-linecap: round; }
.bm .bm-pose-names text { font-weight: 600; fill: var(--bm-muted); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm-bar { stroke-width: 11; stroke-linecap: round; fill: none; }
.bm-core { stroke-width: 7.5; stroke-linecap: round; fill: none; }
.bm-link.bm-side0 .bm-bar { stroke: var(--bm-driver); }
.bm-link.bm-side0 .bm-core { stroke: var(--bm-driver-solid); }
.bm-link.bm-side1 .bm-bar { stroke: var(--bm-follower); }
.bm-link.bm-side1 .bm-core { stroke: var(--bm-panel); }
.bm-inner .bm-bar { stroke: var(--bm-coupler); }
.bm-inner .bm-core { stroke: var(--bm-panel); }
.bm-carried .bm-bar { stroke: var(--bm-coupler); stroke-width: 17; opacity: 0.9; }
.bm-carried .bm-core { stroke: var(--bm-plate); stroke-width: 14; }
.bm-key .bm-carried .bm-bar { stroke-width: 13; }
.bm-key .bm-carried .bm-core { stroke-width: 10; }
.bm-ternary { opacity: 0.86; }
.bm-ternary path { stroke-linejoin: round; }
.bm-ternary.bm-side0 .bm-core { fill: var(--bm-driver-solid); fill-opacity: 0.45; }
.bm-ternary.bm-side1 .bm-core { fill: var(--bm-follower); fill-opacity: 0.12; }
.bm-ternary.bm-inner .bm-core { fill: var(--bm-coupler); fill-opacity: 0.12; }
.bm-ternary.bm-carried .bm-core { fill: var(--bm-plate); }
.bm-plate-rim { fill: none; stroke: var(--bm-coupler); stroke-width: 17; stroke-linejoin: round; stroke-linecap: round; opacity: 0.9; }
.bm-plate { fill: var(--bm-plate); stroke: var(--bm-plate); stroke-width: 14; stroke-linejoin: round; stroke-linecap: round; }
.bm-coupler { opacity: 0.86; }
.bm-spring { fill: none; stroke: var(--bm-spring); stroke-width: 2; stroke-linejoin: round; }
.bm-springs [data-spring="gas"] .bm-spring { fill: var(--bm-panel); fill-opacity: 0.75; }
.bm-spring-end { fill: var(--bm-spring); }
.bm-pin-forces { display: none; }
:root:has(.bm-forces:not([hidden]) .bm-show-forces:checked) .bm-pin-forces { display: inline; }
.bm-pin-force { fill: none; stroke: currentColor; stroke-width: 2; stroke-linejoin: round; }
.bm-pin-newtons { fill: currentColor; font-size: 11px; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm-forces { display: flex; gap: 6px; align-items: baseline; }
.bm-forces[hidden] { display: none; }
.bm-hand { fill: none; stroke: var(--bm-hand); stroke-width: 3; stroke-linecap: round; stroke-linejoin: round; }
.bm-slot-rim { stroke: var(--bm-coupler); stroke-width: 21; stroke-linecap: round; }
.bm-slot-plate { stroke: var(--bm-plate); stroke-width: 18; stroke-linecap: round; }
.bm-slot-edge { stroke: var(--bm-coupler); stroke-width: 12.5; }
.bm-slot { stroke: var(--bm-panel); stroke-width: 10; }
.bm-block rect { stroke-width: 1.6; }
.bm-block.bm-side0 rect { fill: var(--bm-driver-solid); stroke: var(--bm-driver); }
.bm-block.bm-side1 rect { fill: var(--bm-panel); stroke: var(--bm-follower); }
.bm-pin { fill: var(--bm-panel); stroke: var(--bm-ink); stroke-width: 1.8; }
.bm-origin { fill: var(--bm-ink); }
.bm-body-frame { fill: none; stroke: var(--bm-ink); stroke-width: 1.8; }
.bm .bm-letter { font-weight: 700; font-style: italic; }
.bm-to-far { cursor: pointer; }
.bm .bm-error-scale { fill: var(--bm-error); font-size: 11px; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 4px; }
.bm-far-mark { fill: none; stroke-width: 2.4; stroke-linecap: round; stroke-linejoin: round; }
.bm-far-mark.bm-side0 { stroke: var(--bm-driver); }
.bm-far-mark.bm-side1 { stroke: var(--bm-follower); }
.bm-drive-mark { fill: none; stroke: var(--bm-driver); stroke-width: 1.8; stroke-linecap: round; stroke-linejoin: round; }

.bm-controls { display: grid; gap: 6px; margin: 0 0 10px; }
.bm-row { display: flex; flex-wrap: wrap; gap: 8px; align-items: flex-start; }
.bm-button { font: inherit; font-size: 0.9rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 8px; padding: 5px 1\
1px; min-height: 34px; cursor: pointer; display: inline-flex; gap: 7px; align-items: center; white-space: nowrap; }
.bm-button:hover { border-color: var(--bm-muted); }
.bm-button:disabled { opacity: 0.45; cursor: default; }
.bm-play { background: var(--bm-accent); border-color: var(--bm-accent); color: var(--bm-panel); min-width: 92px; justify-content: center; font-weight: 600; }
.bm-play svg { fill: currentColor; }
.bm-whole, .bm-real { display: inline-flex; gap: 6px; align-items: center; min-height: 34px; font-size: 0.9rem; white-space: nowrap; cursor: pointer; }
.bm-whole input, .bm-real input, .bm-far-pivots input, .bm-close-up input { accent-color: var(--bm-accent); margin: 0; }
.bm-whole:has(:disabled) { opacity: 0.45; cursor: default; }
.bm-real[hidden] { display: none; }
.bm-small-step { padding: 5px 9px; }
.bm-pick { font: inherit; font-size: 0.86rem; color: var(--bm-ink); background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 8px; min-heigh\
t: 34px; padding: 2px 4px; }
.bm-track { min-width: 0; }
.bm-slider { display: block; width: 100%; margin: 0 0 2px; height: 18px; accent-color: var(--bm-accent); }
.bm-stops { width: 100%; overflow: visible; }
.bm-stops path { stroke: var(--bm-muted); }
.bm .bm-stops text { font-size: 10.5px; fill: var(--bm-muted); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm-now { display: block; font-size: 0.88rem; min-height: 1.5em; }
.bm-now span { display: inline-block; max-width: 100%; }
.bm-under { display: flex; flex-wrap: wrap; gap: 8px 18px; justify-content: space-between; align-items: flex-end; margin-top: 10px; }
.bm-choose { display: flex; flex-wrap: wrap; gap: 4px 18px; }
.bm-far-pivots, .bm-close-up { display: inline-flex; gap: 6px; align-items: center; cursor: pointer; }
.bm-far-pivots[hidden], .bm-close-up[hidden], .bm-ways[hidden] { display: none; }
.bm-factor { white-space: nowrap; font-size: 0.86rem; color: var(--bm-muted); }
.bm-factor select { font: inherit; color: var(--bm-ink); background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; padding: 2px 6px; }
.bm .bm-keys { list-style: none; display: flex; flex-wrap: wrap; gap: 2px 18px; flex: 1 1 260px; font-size: 0.82rem; color: var(--bm-muted); }
.bm-keys li { display: inline-flex; gap: 6px; align-items: center; }
.bm-key { flex: none; }

.bm-aside { display: grid; gap: 16px; grid-template-columns: minmax(0, 1fr); min-width: 0; }
.bm-facts { display: grid; font-size: 0.9rem; }
.bm-facts div { display: flex; justify-content: space-between; gap: 14px; border-bottom: 1px solid var(--bm-faint); padding: 2px 0; }
.bm-facts dt { color: var(--bm-muted); }
.bm-facts dd { text-align: right; }
.bm-note-text { font-size: 0.82rem; color: var(--bm-muted); margin-top: 8px !important; }
.bm-scroll { overflow-x: auto; margin-top: 8px; scrollbar-width: thin; }
.bm table { border-collapse: collapse; width: 100%; font-size: 0.86rem; }
.bm caption { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
.bm-dimensions caption, .bm-every caption { position: static; width: auto; height: auto; clip-path: none; text-align: left; font-weight: 600; padding: 6px 0 2px\
; }
.bm th, .bm td { text-align: right; padding: 3px 12px 3px 0; border-bottom: 1px solid var(--bm-faint); vertical-align: top; white-space: nowrap; font-weight: 40\
0; }
.bm thead th { color: var(--bm-muted); border-bottom-color: var(--bm-line); white-space: normal; vertical-align: bottom; }
.bm tbody th { text-align: left; font-weight: 650; }
.bm .bm-words { text-align: left; white-space: normal; }
.bm .bm-linkages td.bm-words, .bm .bm-pose-table td.bm-words { white-space: nowrap; }
.bm .bm-linkages th, .bm .bm-linkages td { padding-right: 9px; }
.bm .bm-linkages td:nth-child(3), .bm .bm-linkages td:nth-child(4) { white-space: normal; }
.bm .bm-linkages td:last-child { white-space: normal; min-width: 14rem; overflow-wrap: anywhere; }
.bm .bm-pose-table tbody th { position: sticky; left: 0; background: var(--bm-panel); }
.bm .bm-pose-table tr.bm-current th { background: var(--bm-wash); }
.bm-scroll:has(.bm-pose-table) { max-height: 34rem; overflow-y: auto; }
.bm th:last-child, .bm td:last-child { padding-right: 2px; }
.bm tr.bm-current > * { background: var(--bm-wash); }
.bm .bm-dimensions td { padding-right: 8px; }
.bm .bm-dimensions td:last-child { white-space: normal; padding-right: 0; }
.bm .bm-numbers .bm-scroll { margin-top: 0; }
.bm-numbers .bm-facts { margin-top: 10px; }
.bm-line-of { display: block; white-space: nowrap; }
.bm .bm-joints tbody th { white-space: normal; }
.bm-every { margin-top: 12px; font-size: 0.9rem; }
.bm-every summary { cursor: pointer; color: var(--bm-accent); }
.bm-every-all { display: grid; gap: 6px 28px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 340px), 1fr)); }

.bm-plots { width: 100%; cursor: ew-resize; touch-action: pan-y; }
.bm-panel { fill: none; stroke: var(--bm-line); }
.bm-rule { stroke: var(--bm-faint); fill: none; }
.bm-usual { stroke: var(--bm-muted); stroke-dasharray: 5 4; fill: none; }
.bm .bm-tick { font-size: 11px; fill: var(--bm-muted); }
.bm .bm-halo { paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm .bm-title { font-size: 12px; fill: var(--bm-muted); }
.bm .bm-note { fill: var(--bm-muted); }
.bm-stem { stroke: var(--bm-error); stroke-width: 1.6; }
.bm-dot { fill: var(--bm-error); }
.bm .bm-dot-name { font-size: 11px; font-weight: 600; fill: var(--bm-muted); }
.bm-line { fill: none; stroke: var(--bm-driver); stroke-width: 1.8; }
.bm-line.bm-loop1 { stroke: var(--bm-follower); stroke-dasharray: 6 4; }
.bm-stale { opacity: 0.35; }
.bm-line.bm-curve1 { stroke: var(--bm-follower); stroke-dasharray: 6 4; }
.bm-line.bm-curve2 { stroke: var(--bm-error); }
.bm-line.bm-curve3 { stroke: var(--bm-good); stroke-dasharray: 6 4; }
.bm-line.bm-curve4 { stroke: var(--bm-coupler); }
.bm-line.bm-curve5 { stroke: var(--bm-body); stroke-dasharray: 6 4; }
.bm-line.bm-curve6 { stroke: var(--bm-muted); }
.bm .bm-title tspan { font-weight: 700; fill: var(--bm-driver); }
.bm .bm-title .bm-curve1 { fill: var(--bm-follower); }
.bm .bm-title .bm-curve2 { fill: var(--bm-error); }
.bm .bm-title .bm-curve3 { fill: var(--bm-good); }
.bm .bm-title .bm-curve4 { fill: var(--bm-coupler); }
.bm .bm-title .bm-curve5 { fill: var(--bm-body); }
.bm .bm-title .bm-curve6 { fill: var(--bm-muted); }
.bm-dot.bm-loop0 { fill: var(--bm-driver); }
.bm-dot.bm-loop1 { fill: var(--bm-follower); }
.bm-cursor path { stroke: var(--bm-ink); stroke-width: 1.3; }
.bm-cursor circle { fill: var(--bm-panel); stroke: var(--bm-ink); stroke-width: 1.8; }

.bm-map { position: relative; border: 1px solid var(--bm-line); border-radius: 8px; overflow: hidden; }
.bm-map canvas { display: block; width: 100%; }
.bm-map svg { position: absolute; inset: 0; width: 100%; height: 100%; cursor: crosshair; }
.bm .bm-map svg:focus-visible { outline-offset: -3px; border-radius: 8px; }
.bm-map-cursor { fill: none; stroke: var(--bm-ink); stroke-width: 2; }
.bm-cross { stroke: var(--bm-ink); opacity: 0.75; }
.bm-some-pivot { fill: var(--bm-ink); opacity: 0.55; }
.bm-its-pivot { fill: var(--bm-panel); stroke-width: 3; }
.bm-its-pivot.bm-side0 { stroke: var(--bm-driver); }
.bm-its-pivot.bm-side1 { stroke: var(--bm-follower); }
.bm .bm-map-name { font-weight: 700; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm-pairs { display: grid; gap: 16px; }
.bm-pairs.bm-beside { grid-template-columns: auto auto; justify-content: start; }
.bm-pairs-map { position: relative; overflow: hidden; }
.bm-pairs-map canvas { position: absolute; image-rendering: pixelated; }
.bm-pairs-map svg { position: absolute; inset: 0; width: 100%; height: 100%; cursor: crosshair; }
.bm .bm-pairs-map svg:focus-visible { outline-offset: -3px; border-radius: 8px; }
.bm-pairs-scene { border: 1px solid var(--bm-line); border-radius: 8px; display: block; }
.bm-pairs-axes path, .bm-pairs-axes rect { fill: none; stroke: var(--bm-ink); stroke-width: 1; }
.bm-pairs-axes text { fill: var(--bm-ink); font-size: 11px; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }
.bm-pairs-under path { fill: none; stroke: var(--bm-ink); stroke-width: 6; }
.bm-pairs-curve path { fill: none; stroke-width: 4.4; }
.bm-pairs-mark { fill: var(--bm-ink); stroke: var(--bm-panel); stroke-width: 1; }
.bm-pair-halo { fill: none; stroke: var(--bm-panel); stroke-width: 5; }
.bm-pair-halo.bm-thin { stroke-width: 3; }
.bm-pair-outline { fill: none; stroke: var(--bm-ink); stroke-width: 1.3; }
.bm-pair-ring { fill: none; stroke: var(--bm-error); stroke-width: 2.4; }
.bm-pole { fill: var(--bm-ink); stroke: var(--bm-panel); stroke-width: 1; }
.bm-pair-body { fill: none; stroke: var(--bm-coupler); stroke-width: 2.4; stroke-linejoin: round; paint-order: stroke; }
.bm-pair-link { fill: none; stroke-width: 3; stroke-linecap: round; }
.bm-pair-link.bm-side0 { stroke: var(--bm-driver); }
.bm-pair-link.bm-side1 { stroke: var(--bm-follower); }
.bm-pair-ground { stroke: var(--bm-panel); stroke-width: 1.4; }
.bm-pair-ground.bm-side0 { fill: var(--bm-driver); }
.bm-pair-ground.bm-side1 { fill: var(--bm-follower); }
.bm-pair-pin { fill: var(--bm-panel); stroke: var(--bm-coupler); stroke-width: 1.6; }
.bm-pair-scale { display: inline-block; width: 64px; height: 11px; border: 1px solid var(--bm-muted); border-radius: 2px; vertical-align: -1px; background: line\
ar-gradient(to right, var(--bm-pair-low), var(--bm-pair-middle), var(--bm-pair-high)); }
.bm-pair-key { white-space: nowrap; margin-right: 8px; }
.bm-pair-outside { background: var(--bm-pair-outside); }
.bm-pair-order { background: var(--bm-pair-order); }
.bm-pair-branch { background: var(--bm-pair-branch); }
.bm-pair-circuit { background: var(--bm-pair-circuit); }
.bm-readout { display: block; }
.bm-legend, .bm-readout { font-size: 0.82rem; color: var(--bm-muted); }
.bm .bm-legend { margin-top: 8px; }
.bm-swatch { display: inline-block; width: 14px; height: 11px; border: 1px solid var(--bm-muted); border-radius: 2px; vertical-align: -1px; margin-right: 3px; }\

.bm-swatch.bm-far { margin-left: 12px; }
.bm-near { background: var(--bm-map-near); }
.bm-far { background: var(--bm-map-far); }

.bm-space { position: relative; border: 1px solid var(--bm-faint); border-radius: 8px; touch-action: pan-y; cursor: grab; user-select: none; -webkit-user-select\
: none; }
.bm-space:active { cursor: grabbing; }
.bm-space canvas, .bm-space svg { position: absolute; inset: 0; width: 100%; height: 100%; }
.bm-box { stroke: var(--bm-muted); fill: none; stroke-width: 0.9; opacity: 0.75; }
.bm-box.bm-behind { stroke-dasharray: 3 4; opacity: 0.5; }
.bm .bm-axis { font-size: 11px; fill: var(--bm-muted); }
.bm-motion { fill: none; stroke: var(--bm-ink); stroke-width: 2.4; stroke-linecap: round; }
.bm-motion.bm-other { stroke-width: 1.5; stroke-opacity: 0.75; }
.bm-motion.bm-hidden { stroke-opacity: 0.42; }
.bm-image-point { fill: var(--bm-panel); stroke: var(--bm-ink); stroke-width: 1.8; }
.bm-image-point.bm-hidden { opacity: 0.6; }
.bm .bm-image-name { font-weight: 700; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; stroke-opacity: 0.8; }
.bm-runner { fill: var(--bm-error); stroke: var(--bm-panel); stroke-width: 2; }
.bm-foot-notes { max-width: 1760px; margin: 0 auto; padding: 0 clamp(14px, 2.4cqw, 36px) 28px; color: var(--bm-muted); font-size: 0.82rem; }

@container (max-width: 959px) {
  .bm-main { display: contents; }
  .bm-stage { order: -4; }
  .bm-list { order: -2; }
  .bm-main > .bm-aside, .bm-main > .bm-loaded { order: -3; }
  .bm-choices { align-items: stretch; }
  .bm-choice { flex-basis: 264px; }
  .bm-choice .bm-reason, .bm-choice dl dd.bm-detail, .bm-choice dl dt.bm-detail { display: none; }
}
@container (max-width: 640px) {
  .bm-card { padding: 12px 12px 14px; }
  .bm .bm-dimensions { font-size: 0.8rem; }
  .bm .bm-dimensions td, .bm .bm-dimensions th { padding-right: 6px; }
  .bm .bm-dimensions td:last-child { padding-right: 0; }
  .bm .bm-named tbody th { white-space: normal; min-width: 7rem; max-width: 9rem; overflow-wrap: break-word; }
  .bm .bm-stacks, .bm .bm-stacks tbody { display: block; }
  .bm .bm-stacks thead { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; }
  .bm .bm-stacks tr { display: block; padding: 6px 0; border-bottom: 1px solid var(--bm-line); }
  .bm .bm-stacks tbody th, .bm .bm-stacks td { display: flex; justify-content: space-between; gap: 14px; border: 0; padding: 1px 0; white-space: normal; text-al\
ign: right; min-width: 0; }
  .bm .bm-stacks td.bm-words, .bm .bm-linkages td:last-child { text-align: right; white-space: normal; min-width: 0; }
  .bm .bm-stacks td::before { content: attr(data-head); color: var(--bm-muted); white-space: nowrap; text-align: left; }
  .bm .bm-linkages td:last-child:not(.bm-none) { display: block; text-align: left; color: var(--bm-muted); }
  .bm .bm-linkages td:last-child::before { margin-right: 14px; }
  .bm .bm-stacks td.bm-none { display: none; }
}
@container (min-width: 620px) and (max-width: 959px) {
  .bm-aside { grid-template-columns: repeat(2, minmax(0, 1fr)); }
}
@container (min-width: 960px) {
  .bm-body:has(.bm-list) { grid-template-columns: 250px minmax(0, 1fr); }
  .bm-list { position: sticky; top: 0; align-self: start; max-height: 100vh; display: flex; flex-direction: column; padding-top: 4px; }
  .bm-choices { flex-direction: column; align-items: stretch; overflow: hidden auto; padding-bottom: 16px; }
  .bm-choice { flex: none; }
  .bm-main { grid-template-columns: repeat(10, minmax(0, 1fr)); }
  .bm-stage, .bm-aside, .bm-loaded, .bm-family-curve, .bm-pose-box, .bm-all, .bm-dyads { grid-column: 1 / -1; }
  .bm-aside { grid-template-columns: repeat(2, minmax(0, 1fr)); }
  .bm-image, .bm-pivots, .bm-family-plane { grid-column: span 5; }
}
@container (min-width: 1140px) {
  .bm-stage { grid-column: span 6; align-self: start; }
  .bm-aside { grid-column: span 4; grid-template-columns: minmax(0, 1fr); align-self: start; }
  .bm-main:not(:has(.bm-aside)) .bm-stage { grid-column: 1 / -1; }
  .bm-main:has(.bm-loaded) { grid-template-rows: auto 1fr; }
  .bm-main:has(.bm-loaded) .bm-aside { grid-row: span 2; }
  .bm-loaded { grid-column: span 6; align-self: start; }
}
@media print {
  .bm { --bm-bg: #fff; --bm-panel: #fff; --bm-ink: #000; --bm-muted: #444; --bm-line: #bbb; --bm-faint: #ddd;
    --bm-driver: #1b5cb8; --bm-follower: #a84a12; --bm-coupler: #4a5869; --bm-plate: #d5dce4; --bm-driver-solid: #5b93dd; --bm-follower-solid: #e09b62;
    --bm-wanted: #6c7580; --bm-error: #b0125f; --bm-good: #196b3c; --bm-bad: #9c3118; --bm-wash: #fff; --bm-body: #1c7a6c; --bm-spring: #6b43ab; --bm-hand: #9a5\
a00;
    font-size: 10pt; min-height: 0; }
  .bm-list, .bm-row, .bm-track, .bm-factor, .bm-ways, .bm-every summary, .bm-about summary, .bm-readout { display: none !important; }
  .bm-body, .bm-body:has(.bm-list) { display: block; padding: 0; }
  .bm-main { display: block; }
  .bm-head { padding: 0 0 8px; }
  .bm-card { border: 0; padding: 8px 0; break-inside: avoid; }
  .bm-pose-box, .bm-all, .bm-dyads, .bm-every { break-inside: auto; }
  .bm table { font-size: 8pt; }
  .bm .bm-scroll { overflow: visible; max-height: none; }
  .bm .bm-linkages td.bm-words { white-space: normal; min-width: 0; }
  .bm tr, .bm-every-one { break-inside: avoid; }
  .bm th, .bm td { padding-right: 6px; }
  .bm-foot-notes { padding: 0; }
}
`;var clamp=(value,low,high)=>Math.min(Math.max(value,low),high),degrees=angle=>angle*180/Math.PI,radians=angle=>angle*Math.PI/180,px=value=>Math.abs(value)<1e7?+value.
toFixed(5):Math.sign(value)*1e7;function fixed(value,digits){if(value==null||!Number.isFinite(value))return"–";let text=value.toFixed(digits);return Number(text)===
0?text.replace("-",""):text}function figure(value){if(value===null||!Number.isFinite(value))return"–";if(value===0)return"0";if(Math.abs(value)>=99.5&&Math.abs(
value)<1e6)return value.toFixed(0);let rounded=value.toExponential(1),[digits,power]=rounded.split("e").map(Number);return power>=-4&&power<2?String(Number(rounded)):
power>0?`${digits}e${power}`:`${digits}e-${String(-power).padStart(2,"0")}`}function ticks(low,high,about2){let rough=(high-low)/Math.max(1,about2),power=10**Math.floor(Math.log10(rough)),step=[1,2,5,10].map(k=>k*power).find(each=>each>=
rough*.999)??10*power,digits=Math.max(0,-Math.floor(Math.log10(step*1.0001))),marks=[];for(let k=Math.ceil(low/step-1e-9);k*step<=high+step*1e-9;k+=1)marks.push(
{at:k*step,text:fixed(k*step,digits)});return marks}function listed(words){return words.length<2?words.join(""):`${words.slice(0,-1).join(", ")} and ${words[words.length-1]}`}function runs(numbers,names){let parts=[];
for(let k=0;k<numbers.length;){let end=k;for(;end+1<numbers.length&&numbers[end+1]===numbers[end]+1;)end+=1;if(end-k>=2)parts.push(`${names[numbers[k]-1]}–${names[numbers[end]-
1]}`);else for(let i=k;i<=end;i+=1)parts.push(names[numbers[i]-1]);k=end+1}return listed(parts)}var SVG="http://www.w3.org/2000/svg";function furnish(node,attributes,children){for(let[name,value]of Object.entries(attributes??{}))value==null||value===!1||(name.
startsWith("on")?node.addEventListener(name.slice(2),value):node.setAttribute(name,value===!0?"":value));return node.append(...children.flat(1/0).filter(child=>child!=
null)),node}var h=(tag,attributes,...children)=>furnish(document.createElement(tag),attributes,children),s=(tag,attributes,...children)=>furnish(document.createElementNS(
SVG,tag),attributes,children);function put(node,name,value){let text=String(value);node.getAttribute(name)!==text&&node.setAttribute(name,text)}function give(node,name,value){
let next=typeof node[name]=="boolean"?!!value:String(value);node[name]!==next&&(node[name]=next)}function say(node,text){let next=String(text);node.textContent!==
next&&(node.textContent=next)}var decimalsOf=data=>clamp(4-Math.ceil(Math.log10(data.scene)),0,12),poseName=pose=>pose.label===pose.name?pose.name:`${pose.label}: ${pose.name}`,isPoint=pose=>pose.
angle_deg===null,nounOf=({poses,stop=void 0})=>stop??(poses.length&&poses.every(isPoint)?"point":"pose");var calledOf=pose=>pose.called??`${isPoint(pose)?"point":"pose"} ${poseName(pose)}`,shortened=(text,most)=>text.length>most?`${text.slice(0,most-1).trimEnd()}…`:
text;function missOf(position,angle,unit){if(position==="-")return"–";let[away,...share]=position.split(" ("),length=[away==="exact"?away:`${away}${unit}`,...share].
join(" (");return angle==="free"||position==="exact"&&angle==="exact"?length:`${length} and ${angle}`}function wayName(way,linkage){let circuits=new Set(linkage.ways.map(each=>each.circuit)).size,parts=[];return(circuits>1||way.branches<2)&&parts.push(`assembly ${way.
circuit}`),way.branches>1&&parts.push(`branch ${way.branch}`),parts.join(", ")}function withKeys(object,changes){let copy={...object,...changes};for(let[key,value]of Object.entries(changes))value===void 0&&delete copy[key];return copy}var replaced=(list,index,value)=>list.
map((each,k)=>k===index?value:each),without=(list,index)=>list.filter((_,k)=>k!==index),inserted=(list,index,value)=>[...list.slice(0,index),value,...list.slice(
index)],withList=(document2,key,list)=>withKeys(document2,{[key]:list.length?list:void 0}),filled=table=>Object.keys(table).length?table:void 0,EXACT={x:0,y:0,angle_deg:0},
FEWEST_TRACED=10,isFree=(pose,key)=>!!pose?.free?.includes(key)||pose?.tolerance?.[key]==="free",isPoint2=pose=>isFree(pose,"angle"),isOfPoints=({poses})=>poses.
length>0&&poses.every(isPoint2),isPath=document2=>isOfPoints(document2)&&(document2.path!==void 0||document2.poses.length>=FEWEST_TRACED),setPath=(document2,changes)=>withKeys(
document2,{path:withKeys(document2.path??{closed:!1},changes)});var isExact=tolerance=>tolerance&&["x","y","angle_deg"].every(key=>!tolerance[key]);function settled(document2){let{poses,path,tolerance}=document2,some=poses.some(
pose=>pose.free?.length);return withKeys(document2,{path:path&&poses.length&&!poses.every(isPoint2)?void 0:path,tolerance:some?tolerance??EXACT:isExact(tolerance)?
void 0:tolerance})}var withCrank=(document2,change)=>document2.path?.crank_deg?setPath(document2,{crank_deg:change(document2.path.crank_deg)}):document2;function betweenCranks(angles,index){
let[a,b]=[angles[index-1],angles[index]];return a!==void 0&&b!==void 0?(a+b)/2:a===void 0?(b??0)-10:a+(a-(angles[index-2]??a-10))}var setPose=(document2,index,changes)=>withKeys(
document2,{poses:replaced(document2.poses,index,withKeys(document2.poses[index],changes))}),addPose=(document2,pose,index=document2.poses.length)=>settled(withCrank(
withKeys(document2,{poses:inserted(document2.poses,index,pose)}),angles=>inserted(angles,index,betweenCranks(angles,index)))),removePose=(document2,index)=>settled(
withCrank(withKeys(document2,{poses:without(document2.poses,index)}),angles=>without(angles,index))),removePoses=(document2,indices)=>[...indices].sort((a,b)=>b-
a).reduce(removePose,document2);var setBody=(document2,corners)=>withList(document2,"body",corners),bodyOf=document2=>Array.isArray(document2.body)?document2.body:[],regionsOf=document2=>document2.
keep_out===void 0?[]:[document2.keep_out].flat(),addRegion=(document2,region)=>withList(document2,"keep_out",[...regionsOf(document2),region]),setRegion=(document2,index,changes)=>withList(
document2,"keep_out",replaced(regionsOf(document2),index,withKeys(regionsOf(document2)[index],changes))),removeRegion=(document2,index)=>withList(document2,"kee\
p_out",without(regionsOf(document2),index));var limitsOf=document2=>document2.limits===void 0?[]:[document2.limits].flat();function setLimit(document2,index,changes){let tables=limitsOf(document2),changed2=withKeys(
tables[index]??{},changes),all=index<tables.length?replaced(tables,index,changed2):[...tables,changed2],kept=all.length>1||filled(changed2)?all:[];return withKeys(
document2,{limits:kept.length>1?kept:kept[0]})}var limitRegions=document2=>limitsOf(document2).flatMap((table,index)=>["fixed_pivot","moving_pivot"].filter(key=>table[key]).map(key=>{let[[shape,points]]=Object.
entries(table[key]);return{table:index,key,shape,points:shape==="point"?[points]:points}})),shapeOf=(shape,points)=>({[shape]:shape==="point"?points[0]:points}),
setRequirement=(document2,key,value)=>withKeys(document2,{requirements:filled(withKeys(document2.requirements??{},{[key]:value}))});function component(poses,index,key){
if(Number.isFinite(poses[index][key]))return poses[index][key];let before=poses.slice(0,index).findLastIndex(pose=>Number.isFinite(pose[key])),behind=poses.slice(
index+1).findIndex(pose=>Number.isFinite(pose[key]))+index+1,[a,b]=[poses[before]?.[key],behind>index?poses[behind][key]:void 0];return a===void 0||b===void 0?a??
b??0:a+(index-before)/(behind-before)*(b-a)}function standing({poses},index){let{x,y,angle}=poses[index];return Number.isFinite(x)&&Number.isFinite(y)&&Number.isFinite(
angle)?{x,y,angle}:{x:component(poses,index,"x"),y:component(poses,index,"y"),angle:component(poses,index,"angle")}}var poseName2=({poses},index)=>(poses[index]?.
name??String(index+1)).replace(/[\r\n\u2028\u2029]+/g," "),statedOf=(pose,changes)=>Object.fromEntries(Object.entries(changes).filter(([key])=>Number.isFinite(pose[key])));var Events=class{heard;on(names,fn){this.heard??=new Map;for(let name of names.split(" "))this.heard.set(name,[...this.heard.get(name)??[],fn])}emit(name,...values){
for(let fn of this.heard?.get(name)??[])fn(...values)}};var LONGEST_NAME=5,FOLLOWED=1e-7,EXACT_TURN=1e-5,UNSEEN=1e-6,PLACED="placed",NOTHING={poses:[],body:null,keep_out:[],loads:null,scene:1,unit:null,dyads:[],linkages:[],
dyads_title:"Dyads",chart:{origin:[0,0],angle:0,length:1},space:{centre:[0,0,0],half:[1,1,1],quadrics:[]},pivot_map:null,family_map:null,transmission_limit:{deg:40,
said:"40°, a usual limit"},keys:[],table:null,best:[],warnings:[],footnotes:""},Answers=class extends Events{constructor(store){super(),this.store=store,this.data=
{...NOTHING},this.linkages=[],this.gone=[],this.byId=new Map,this.placed=null,store.on("solved",()=>this.takeSolved()),store.on("followed",()=>this.takeFollowed()),
store.on("document",()=>this.takePoses()),store.on("chosen",()=>this.emit("shown")),store.on("placed",()=>this.takePlaced()),this.takePoses(),store.solved&&this.
takeSolved()}get shown(){return this.get(this.store.chosen)??(this.store.chosen===PLACED?void 0:this.linkages[0])}get(id){return id===PLACED?this.placed??void 0:
this.byId.get(id)}get isOld(){return this.store.solvedFor!==this.store.document}takePoses(){let poses=posesOf(this.store.document);Object.assign(this.data,{poses,
isPath:isPath(this.store.document),...surroundingsOf(this.store.document,this.data)}),this.emit("poses")}takeSolved(){let{solved,document:document2}=this.store,
before=this.linkages.filter(each=>!each.gone),{renamed:names,moved:moved2}=this.store,was=new Map([...names].map(([old,id])=>[id,this.byId.get(old)])),{poses,body,
keep_out,...rest}=solved;Object.assign(this.data,{body,keep_out,...rest,poses:posesOf(document2)}),this.gone=this.store.isEmpty||this.store.isAnother?[]:before.
filter(each=>!names.has(each.id)).map(each=>each.id),this.byId=new Map,this.linkages=solved.linkages.map(fresh=>{let kept=was.get(fresh.id),now=kept??{},stood=kept&&
kept.rank!==1/0,before2=stood&&kept.id!==fresh.id?kept.id:null;for(let key of Object.keys(now))delete now[key];return Object.assign(now,figured(linked(fresh)),{
was:before2,shift:moved2.get(fresh.id)??0,isNew:this.known&&!this.store.isAnother&&!stood,followed:!1,gone:null,change:null}),this.byId.set(now.id,now),now}),this.
known=!this.store.isEmpty,this.emit("answers")}takeFollowed(){let frame=this.store.followed;if(frame){for(let each of frame.linkages){let now=this.byId.get(each.
id);now&&each.fresh===!1||(now||(now=appeared(each),this.byId.set(each.id,now),this.linkages.push(now),this.hasNew=!0),follow(now,each,this.data))}for(let{id,message}of frame.
vanished??[]){let now=this.byId.get(id);now&&Object.assign(now,{gone:message,usable:!1})}for(let{id,kind,message}of frame.changes??[]){let now=this.byId.get(id);
now&&kind!=="vanished"&&(now.change=message)}this.hasNew?(this.hasNew=!1,this.emit("answers")):this.emit("moved")}}takePlaced(){let placed=this.store.placed?.linkage,
{cognateOf}=this.store.placed??{},called=cognateOf?`Cognate of ${cognateOf}`:"By hand",before=this.placed;this.placed=placed?Object.assign(before??{},figured(linked(
placed)),{id:PLACED,called,gone:null,followed:!1}):null,this.emit("placed"),this.store.chosen===PLACED&&this.emit(before&&placed?"moved":"shown")}},linked=linkage=>({
...linkage,pose_errors:linkage.pose_errors.map(row=>({...row,at:row.way===null?null:linkage.ways[row.way]}))}),figured=linkage=>Object.assign(linkage,{worst:linkage.
position_error.max,least:linkage.min_transmission_angle_deg.range});function posesOf({poses=[]}){let names=poses.map((pose,k)=>pose.name||String(k+1)),short=names.
every(name=>name.length<=LONGEST_NAME);return poses.map((pose,k)=>({...pose,angle_deg:isPoint2(pose)?null:pose.angle,name:names[k],label:short?names[k]:String(k+
1)}))}var surroundingsOf=(document2,data)=>({body:Array.isArray(document2.body)?document2.body:document2.body===void 0?null:data.body});function follow(now,each,data){
if(now.usable=each.usable,now.led=each.led,now.worst=each.worst,now.least=each.transmission_deg,now.reason=each.reason,now.followed=!0,now.gone=null,each.type&&
(now.type=each.type),!each.ways?.length){now.ways=now.ways??[];return}now.ways=each.ways,now.pose_errors=each.pose_errors.map(row=>({...row,at:row.way===null?null:
each.ways[row.way],said:row.x===null?{position:"-",turned:"-",transmission:"-"}:{position:row.position<FOLLOWED*data.scene?"exact":figure(row.position),turned:row.
turned_deg<EXACT_TURN?"exact":`${figure(row.turned_deg)}°`,transmission:row.transmission_deg===null?"-":`${fixed(row.transmission_deg,1)}°`}}))}var appeared=each=>({
id:each.id,type:each.type??"linkage",rank:1/0,dyads:each.led,ways:[],pose_errors:[],isNew:!0,followed:!0,said:{met:"",story:"",facts:[],reasons:[],quality:{},dimensions:[],
notes:[],links:null,manifolds:[[],[]],worst:"–",rms:"–",transmission:"-"},space:null,shortcomings:[],defects:[],unmet:[]});function worstOf(linkage,data){return linkage.
worst===null||linkage.worst===void 0?"–":linkage.followed?linkage.worst<FOLLOWED*data.scene?"exact":`${figure(linkage.worst)}${data.unit?` ${data.unit}`:""}`:
linkage.said.worst==="-"?"–":linkage.said.worst==="exact"?"exact":`${linkage.said.worst}${data.unit?` ${data.unit}`:""}`}function pathErrorOf(linkage,data){let{
rms}=linkage.said,worst=worstOf(linkage,data);return linkage.followed||!rms||rms==="-"||rms==="exact"?worst:`${rms} rms, ${worst} at most`}function leastOf(linkage){
return linkage.followed?linkage.least===null||linkage.least===void 0?"–":`${Math.floor(10*linkage.least+1e-6)/10}°`:linkage.said.transmission==="-"?"–":linkage.
said.transmission}var AXIS=26,BLOCK=[22,14],transform=(x,y,angle)=>`translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;function foot(){let hatch="";for(let k=-2;k<=2;k+=
1)hatch+=`M${5.5*k+3} 16l-6 7`;return s("g",{class:"bm-foot"},s("path",{class:"bm-solid",d:"M0 0L-10 16H10Z"}),s("path",{class:"bm-ground",d:`M-16 16H16${hatch}`}))}
function axes(length){let l=length,head=Math.max(4,.22*length);return`M0 0H${l}m${-head} ${-head/2}l${head} ${head/2}l${-head} ${head/2}M0 0V${-.6*l}`}function hull(points){let sorted=[...points].sort((p,q)=>p[0]-q[0]||p[1]-q[1]),half=list=>{let kept=[];for(let point of list){for(;kept.length>1;){let[a,b]=kept.
slice(-2);if((b[0]-a[0])*(point[1]-a[1])-(b[1]-a[1])*(point[0]-a[0])>0)break;kept.pop()}kept.push(point)}return kept.slice(0,-1)},corners=[...half(sorted),...half(
sorted.reverse())];return corners.length?corners:sorted.slice(0,1)}function act(place,[x,y]){let c=Math.cos(place.a),d=Math.sin(place.a);return[place.x+c*x-d*y,place.y+d*x+c*y]}function back(place,[x,y]){let c=Math.cos(place.a),
d=Math.sin(place.a);return[c*(x-place.x)+d*(y-place.y),-d*(x-place.x)+c*(y-place.y)]}var normalOf=dyad=>{let angle=radians(dyad.line.normal_deg);return[Math.cos(
angle),Math.sin(angle)]};function constraint(dyad,place){if(dyad.kind==="PP"){let away=place.a-radians(dyad.angle_deg);return[away-2*Math.PI*Math.round(away/(2*
Math.PI)),0,0,1]}if(dyad.kind==="RP"){let[nx2,ny2]=normalOf(dyad),c=Math.cos(place.a),d=Math.sin(place.a),tx=c*nx2-d*ny2,ty=d*nx2+c*ny2,ax=dyad.fixed_pivot[0]-place.
x,ay=dyad.fixed_pivot[1]-place.y;return[tx*ax+ty*ay-dyad.line.offset,-tx,-ty,tx*ay-ty*ax]}let[x,y]=act(place,dyad.moving_pivot),nx,ny,residual;if(dyad.kind==="R\
R"){let ax=x-dyad.fixed_pivot[0],ay=y-dyad.fixed_pivot[1],size2=Math.hypot(ax,ay)||1;[nx,ny,residual]=[ax/size2,ay/size2,size2-dyad.radius]}else[nx,ny]=normalOf(
dyad),residual=nx*x+ny*y-dyad.line.offset;return[residual,nx,ny,(x-place.x)*ny-(y-place.y)*nx]}function project(dyads,place,length){let{x,y,a}=place;for(let step=0;step<4;step+=1){let[f,...p]=constraint(dyads[0],{x,y,a}),[g,...q]=constraint(dyads[1],{x,y,
a});p[2]/=length,q[2]/=length;let pp=p[0]*p[0]+p[1]*p[1]+p[2]*p[2],pq=p[0]*q[0]+p[1]*q[1]+p[2]*q[2],qq=q[0]*q[0]+q[1]*q[1]+q[2]*q[2],det=pp*qq-pq*pq;if(!(det>1e-9*
pp*qq))return{x,y,a};let u=(f*qq-g*pq)/det,v=(g*pp-f*pq)/det;if(x-=u*p[0]+v*q[0],y-=u*p[1]+v*q[1],a-=(u*p[2]+v*q[2])/length,Math.abs(f)+Math.abs(g)<1e-14*length)
break}return{x,y,a}}function catmullRom(values,i,share,round){let last=values.length-1,at=k=>{if(k>=0&&k<=last)return values[k];if(!round)return k<0?2*values[0]-
values[-k]:2*values[last]-values[2*last-k];let wrap=k<0?k+last:k-last;return values[wrap]+(k<0?-1:1)*(values[last]-values[0])},[p,q,r,t]=[at(i-1),at(i),at(i+1),
at(i+2)];return q+share/2*(r-p+share*(2*p-5*q+4*r-t+share*(3*(q-r)+t-p)))}function placeAt(linkage,way,u,length){if(way.joints)return placeOfJoints(linkage,way,
way.joints,u);let stop=linkage.pose_errors.find(row=>row.at===way&&Math.abs(row.frame-u)<1e-6);if(stop)return{x:stop.x,y:stop.y,a:radians(stop.angle_deg)};let i=clamp(
Math.floor(u),0,way.x.length-2),share=u-i,place={x:catmullRom(way.x,i,share,way.round),y:catmullRom(way.y,i,share,way.round),a:catmullRom(way.angle,i,share,way.
round)};return project(linkage.led,place,length)}function placeOfJoints({ground},way,moving,u){let at=values=>smooth(values,u),joints={...ground};for(let[name,[
x,y]]of Object.entries(moving))joints[name]=[at(x),at(y)];return{x:at(way.x),y:at(way.y),a:at(way.angle),joints}}function smooth(values,u){let count=Math.min(6,
values.length),first=clamp(Math.floor(u)-2,0,values.length-count),sum=0;for(let j=0;j<count;j+=1){let weight=1;for(let k=0;k<count;k+=1)k!==j&&(weight*=(u-first-
k)/(j-k));sum+=weight*values[first+j]}return sum}function linear(values,u){let i=clamp(Math.floor(u),0,values.length-2),share=u-i,before=values[i],after=values[i+
1];if(before===null||after===null)return null;let value=before+share*(after-before);return Number.isNaN(value)?null:value}function valueAt({x,y,stems=!1},at){if(at===
null)return null;let here=x.findIndex(each=>Math.abs(each-at)<1e-6);return here>=0?y[here]:stems||!(at>x[0]&&at<x[x.length-1])?null:linear(y,frameAt(x,at))}function frameAt(values,wanted){
let low=0,high=values.length-1;if(wanted<=values[low])return low;if(wanted>=values[high])return high;for(;high-low>1;){let middle2=low+high>>1;values[middle2]<=
wanted?low=middle2:high=middle2}let step=values[high]-values[low];return low+(step>0?(wanted-values[low])/step:0)}var COILS=9,LEAD=.15,BARREL=.6,HALF_WIDTH=6,LEAST_ARROW=16,LONGEST_ARROW=62,RADIUS=11,TURNS=2.25,LONGEST_FORCE=90,LEAST_FORCE=2,BARB=[9,4.5];function springPath(kind,[
x,y],[u,v]){let length=Math.hypot(u-x,v-y)||1,across=[-HALF_WIDTH*(v-y)/length,HALF_WIDTH*(u-x)/length],at=(share,side)=>`${px(x+share*(u-x)+side*across[0])} ${px(
y+share*(v-y)+side*across[1])}`;if(kind==="constant")return`M${at(0,0)}L${at(1,0)}`;if(kind==="gas")return`M${at(0,1)}L${at(BARREL,1)}L${at(BARREL,-1)}L${at(0,-1)}\
ZM${at(BARREL,0)}L${at(1,0)}`;let teeth=Array.from({length:2*COILS+1},(_,k)=>at(LEAD+(1-2*LEAD)*k/(2*COILS),k%(2*COILS)?k%2?1:-1:0));return`M${[at(0,0),...teeth,
at(1,0)].join("L")}`}function roundPath(kind,[x,y]){return kind!=="torsion"?`M${px(x-RADIUS)} ${px(y)}a${RADIUS} ${RADIUS} 0 1 0 ${2*RADIUS} 0a${RADIUS} ${RADIUS}\
 0 1 0 ${-2*RADIUS} 0h${2*RADIUS}M${px(x)} ${px(y-RADIUS)}v${2*RADIUS}`:`M${Array.from({length:55},(_,k)=>[k/54*RADIUS,k/54*2*Math.PI*TURNS]).map(([r,turn])=>`${px(
x+r*Math.cos(turn))} ${px(y-r*Math.sin(turn))}`).join("L")}`}function markPoints({loads},places){if(!loads)return[];let ends=loads.springs.flatMap(spring=>spring.
ends),on=name=>ends.filter(({link})=>link===name).map(({point})=>point);return[...on("ground"),...places.flatMap(place=>[...on("body"),...loads.hand?[loads.hand]:
[]].map(point=>act(place,point)))]}function arrowPath([x,y],angle,length){let c=Math.cos(angle),d=-Math.sin(angle),tip=[x+length*c,y+length*d],barb=side=>`${px(
tip[0]-BARB[0]*c-side*BARB[1]*d)} ${px(tip[1]-BARB[0]*d+side*BARB[1]*c)}`;return`M${px(x)} ${px(y)}L${tip.map(px).join(" ")}M${barb(1)}L${tip.map(px).join(" ")}\
L${barb(-1)}`}var LoadMarks=class{constructor(){this.springs=s("g",{class:"bm-springs"}),this.hand=s("path",{class:"bm-hand"}),this.forces=s("g",{class:"bm-pin-\
forces"}),this.group=s("g",{class:"bm-loads"},this.springs,this.hand,this.forces)}shape(data,linkage,view){this.view=view,this.loads=data.loads??null,this.known=
(linkage.followed?null:linkage.loads)??null;let springs=this.loads?.springs??[];for(;this.springs.children.length>springs.length;)this.springs.lastChild?.remove();
for(;this.springs.children.length<springs.length;)this.springs.append(s("g",{},s("path",{class:"bm-spring"}),s("circle",{class:"bm-spring-end",r:2.6}),s("circle",
{class:"bm-spring-end",r:2.6})));springs.forEach(({kind,ends},k)=>{let[,...marks]=this.springs.children[k].children;put(this.springs.children[k],"data-spring",kind);
for(let mark of marks)put(mark,"visibility",ends.length>1?"inherit":"hidden")});let pins=this.known?.pins??[];this.greatest=Math.max(0,...pins.flatMap(({force:[
x,y]})=>x.map((each,i)=>each===null||y[i]===null?0:Math.hypot(each,y[i])))),this.forces.replaceChildren(...pins.map(({name})=>s("g",{"data-pin":name},s("path",{
class:"bm-pin-force"}),s("text",{class:"bm-pin-newtons"}))))}show(place,drive){let{loads,view}=this;if(!loads||!view){put(this.hand,"d","");return}loads.springs.
forEach(({kind,ends},k)=>{let at=ends.map((end,j)=>this.endOf(end,k,j,place,drive)),group=this.springs.children[k];put(group,"visibility",at.every(Boolean)?"inh\
erit":"hidden"),at.every(Boolean)&&(put(group.children[0],"d",at.length>1?springPath(kind,at[0],at[1]):roundPath(kind,at[0])),at.forEach(([x,y],j)=>{put(group.children[j+
1],"cx",px(x)),put(group.children[j+1],"cy",px(y))}))}),(this.known?.pins??[]).forEach((pin,k)=>this.showForce(this.forces.children[k],pin,drive));let pushes=this.
known?.hand,angle=pushes&&drive!==null?valueAt(pushes,drive):null;if(!loads.hand||angle===null)put(this.hand,"d","");else{let force=valueAt({x:pushes.x,y:pushes.
force},drive)??0,size2=LEAST_ARROW+(LONGEST_ARROW-LEAST_ARROW)*Math.abs(force);put(this.hand,"d",arrowPath(this.seen(act(place,loads.hand)),force<0?angle+Math.PI:
angle,size2))}}showForce(group,{at,force},drive){let place=drive===null?[null]:at.map(each=>valueAt(each,drive)),[x,y]=drive===null?[null,null]:force.map(each=>valueAt(
{x:at[0].x,y:each},drive)),known=place.every(each=>each!==null)&&x!==null&&y!==null,size2=known?Math.hypot(x,y):0,long=this.greatest?LONGEST_FORCE*size2/this.greatest:
0;if(put(group,"visibility",long>LEAST_FORCE?"inherit":"hidden"),!(long>LEAST_FORCE))return;let from=this.seen(place),c=x/size2,d=y/size2;put(group.children[0],
"d",arrowPath(from,Math.atan2(y,x),long)),put(group.children[1],"x",px(from[0]+(long+6)*c)),put(group.children[1],"y",px(from[1]-(long+6)*d+4)),put(group.children[1],
"text-anchor",c<-.3?"end":c>.3?"start":"middle"),group.children[1].textContent=`${group.dataset.pin} ${Number(size2.toPrecision(3))} N`}seen([x,y]){let{view}=this;
return view?[view.X(x),view.Y(y)]:[0,0]}endOf({link,point},spring,end,place,drive){if(link==="ground")return this.seen(point);if(link==="body")return this.seen(
act(place,point));let known=this.known?.moved.find(each=>each.spring===spring&&each.end===end),at=known&&drive!==null?known.at.map(each=>valueAt(each,drive)):[null];
return at.some(each=>each===null)?null:this.seen(at)}};var LEAST_STRETCH=1e-6;function stretchOf(linkage,index,whole=!1){let last=(linkage?.ways[index]?.x.length??2)-1,frames=linkage.pose_errors.filter(row=>row.way===
index).map(row=>row.frame),low=frames.reduce((a,b)=>Math.min(a,b),last),high=frames.reduce((a,b)=>Math.max(a,b),0),isApart=high-low>LEAST_STRETCH,sense=frames[frames.
length-1]<frames[0]?-1:1;return{...isApart&&!whole?{low,high}:{low:0,high:last},sense,isApart}}function driveAtTime({time:{x,y}},time){return y[0]<=y[y.length-1]?valueAt({x:y,y:x},time):valueAt({x:[...y].reverse(),y:[...x].reverse()},time)}function alongLine(dyad,place){
let[nx,ny]=normalOf(dyad),[x,y]=dyad.kind==="PR"?act(place,dyad.moving_pivot):back(place,dyad.fixed_pivot);return nx*y-ny*x}function travelOf(dyad,places){let along2=places.
map(place=>alongLine(dyad,place));return[along2.reduce((a,b)=>Math.min(a,b)),along2.reduce((a,b)=>Math.max(a,b))]}function pointOnLine(dyad,along2){let[nx,ny]=normalOf(
dyad),{offset}=dyad.line;return[offset*nx-along2*ny,offset*ny+along2*nx]}var WIDEST=4,ROOM=2.5,SPARE=.75;var MOST_PLACES=400,INSET=12,bounds=points=>points.reduce(([x,y,u,v],[a,b])=>Number.isFinite(a+b)?[Math.min(x,a),Math.min(y,b),Math.max(u,a),Math.max(v,b)]:[x,y,
u,v],[1/0,1/0,-1/0,-1/0]),placesAtPoses=(data,linkage)=>data.poses.flatMap((pose,k)=>{let row=linkage?.pose_errors[k],at=row&&row.x!==null?row:pose;return at.angle_deg===
null?[]:[{x:at.x,y:at.y,a:radians(at.angle_deg),k}]});function farFrom(data){let[x,y,u,v]=bounds(data.poses.map(pose=>[pose.x,pose.y])),reach=(data.body??[]).reduce(
(most,[a,b])=>Math.max(most,Math.hypot(a,b)),0);return point=>!(Math.hypot(point[0]-(x+u)/2,point[1]-(y+v)/2)<Math.max(WIDEST*data.scene,reach))}function pivotsAt(linkage,places){
let fixed2=linkage.led.flatMap(dyad=>dyad.fixed_pivot?[dyad.fixed_pivot]:[]),own=linkage.led.flatMap(dyad=>dyad.moving_pivot?[dyad.moving_pivot]:dyad.kind==="RP"&&
places.length?travelOf(dyad,places).map(end=>pointOnLine(dyad,end)):[]);return[...fixed2,...places.flatMap(place=>[...own.map(point=>act(place,point)),...Object.
values(place.joints??{})])]}function nearPoints(data,linkage,places,{far=!1,close=!1}={}){let isFar=farFrom(data),seen2=point=>far||!isFar(point),reached=linkage?
[...linkage.pose_errors.filter(row=>row.x!==null),...places]:[],points=[...[...data.poses,...reached].map(({x,y})=>[x,y]),...linkage?[...pivotsAt(linkage,places),
...markPoints(data,places)]:[]],some=places.filter((place,k)=>k%Math.ceil(places.length/MOST_PLACES)===0&&seen2([place.x,place.y])),corners=data.body&&!close?[...placesAtPoses(
data,linkage),...some].flatMap(place=>data.body.map(corner=>act(place,corner))):[];return[...points.filter(seen2),...corners]}function fitted(near2,others,whole){
let all=bounds([...near2,...others]),[x,y,u,v]=bounds(near2),size2=Math.max(u-x,v-y)||1,reach=SPARE*size2;return whole||!near2.length||Math.max(all[2]-all[0],all[3]-
all[1])<=ROOM*size2?all:[Math.max(all[0],x-reach),Math.max(all[1],y-reach),Math.min(all[2],u+reach),Math.min(all[3],v+reach)]}function viewOf(box,width,height,margin){let scale=Math.min((width-2*margin)/(box[2]-box[0]),(height-2*margin)/(box[3]-box[1])),left=width/2-scale*(box[0]+box[2])/
2,top=height/2+scale*(box[1]+box[3])/2;return{scale,left,top,width,height,X:x=>left+scale*x,Y:y=>top-scale*y}}function edgeTowards({X,Y,width,height},at){let x=X(
at[0]),y=Y(at[1]),cx=width/2,cy=height/2;if(x>=0&&y>=0&&x<=width&&y<=height)return null;let size2=Math.hypot(x-cx,y-cy),u=(x-cx)/size2,v=(y-cy)/size2,reach=Math.
min((cx-INSET)/Math.abs(u),(cy-INSET)/Math.abs(v));return{x:cx+reach*u,y:cy+reach*v,angle:Math.atan2(-v,u)}}var MANY_GHOSTS=6;var closed=(points,view,[x,y])=>`M${points.map(each=>`${px(x+view.scale*each[0])} ${px(y-view.scale*each[1])}`).join("L")}Z`,bodyOutline=(data,view)=>closed(data.
body,view,[0,0]),hasGhost=(k,count)=>count<=MANY_GHOSTS||k===0||k===count-1;var Pace=class{timer;constructor(work,wanted=()=>!0){this.work=work,this.wanted=wanted,this.free=0,this.timer=null,paces.add(this)}ask(){this.timer!==null||!this.
wanted()||(this.timer=setTimeout(()=>this.now(),Math.max(0,this.free-performance.now())))}catchUp(){this.timer!==null&&this.now()}now(){clearTimeout(this.timer),
this.timer=null;let start=performance.now();this.work();let end=performance.now();this.free=end+Math.max(250,8*(end-start))}},shown=new WeakMap;function isOther(element,facts){
let before=shown.get(element);return shown.set(element,facts),before?.length!==facts.length||facts.some((fact,k)=>!Object.is(fact,before[k]))}var paces=new Set;var LENGTHS={µm:1e-6,um:1e-6,mm:.001,cm:.01,m:1,in:.0254,inch:.0254,'"':.0254,"″":.0254,ft:.3048,"'":.3048,"′":.3048},ANGLES={"°":1,deg:1,degree:1,degrees:1,
rad:180/Math.PI,mrad:.18/Math.PI},WRITTEN=/^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[+-]?\d+)?)\s*(.*)$/i,DIGITS=12,GREATEST=1e300,tidy=value=>Number(value.toPrecision(
DIGITS)),written=value=>value==null?"":String(value).replace("-","−").replace("e−","e-");function quantity(text,{kind="number",unit="",optional=!1,least:least2=-1/0,
above=-1/0,below=1/0,whole=!1}={}){let plain=text.normalize("NFKC").replace(/[−–]/g,"-").replace(/[\u00a0\u2009\u202f]/g," ").trim(),example={length:unit in
LENGTHS?"12.5 or 0.5 in":"12.5",angle:"30 or 0.5 rad",number:"12.5"}[kind];if(!plain)return optional?{value:void 0}:{fault:`A number is missing here: write one \
such as ${example}.`};let found=WRITTEN.exec(plain);if(!found)return{fault:`“${text.trim()}” is not a number: write one such as ${example}.`};let number=Number(
found[1].replace(",",".")),name=found[2].trim().replace(/^μm$/,"µm"),factor=factorOf(name,kind,unit);if(typeof factor=="string")return{fault:factor};let value=factor===
1?number:tidy(number*factor);if(!(Math.abs(value)<=GREATEST))return{fault:`${text.trim()} is too large a number.`};let shown2=kind==="angle"?"°":kind==="length"&&
unit?` ${unit}`:"";return whole&&!Number.isInteger(value)?{fault:`This has to be a whole number, such as ${Math.max(1,Math.round(value))}.`}:value<least2?{fault:`\
This may not be less than ${least2}${shown2}.`}:value<=above?{fault:`This must be greater than ${above}${shown2}.`}:value>=below?{fault:`This must be less than ${below}${shown2}\
.`}:{value}}function factorOf(name,kind,unit){if(!name||kind==="length"&&name===unit)return 1;if(kind==="number")return`“${name}” is not needed here: write th\
e number alone.`;let units=kind==="angle"?ANGLES:LENGTHS,known=name in units?name:name.toLowerCase();return Object.hasOwn(units,known)?kind==="angle"?units[known]:
Object.hasOwn(LENGTHS,unit)?units[known]/LENGTHS[unit]:`This task has ${unit?`the unit ${unit}`:"no unit of length"}: write the number alone.`:`“${name}” is n\
ot a unit of ${kind} known here: write ${kind==="angle"?"° or rad":"mm, cm, m, in or ft"}, or the number alone.`}var made=0,NumberField=class{constructor({label,options,commit,step=()=>1,attributes={}}){made+=1,this.options=options,this.commit=commit,this.value=void 0,this.
drafts=new Map,this.fault=h("p",{class:"bs-fault",id:`bs-fault-${made}`,hidden:!0}),this.input=h("input",{class:"bs-number",type:"text",inputmode:"text",autocomplete:"\
off",spellcheck:"false","aria-label":label,...attributes,onchange:()=>this.read(),oninput:()=>this.fault.hidden||this.read(),onkeydown:event=>this.nudge(event,step())}),
this.element=h("span",{class:"bs-field"},this.input,this.fault)}show(value){let changed2=value!==this.value;if(this.value=value,changed2||this.fault.hidden){let text=written(
value);this.input.value!==text&&!(this.isEdited&&!changed2)&&(this.input.value=text),changed2&&this.say(null)}}turnTo(id,value){if(id===this.id)return;this.fault.
hidden?this.drafts.delete(this.id):this.drafts.set(this.id,this.input.value);let draft=this.drafts.get(id);this.id=id,this.value=value,give(this.input,"value",draft??
written(value)),this.say(draft===void 0?null:quantity(draft,this.options()).fault??null)}get isEdited(){return document.activeElement===this.input&&this.input.value!==
written(this.value)}read(){let{value,fault}=quantity(this.input.value,this.options());if(this.say(fault??null),fault)return;let isNew=value!==this.value;this.value=
value,(document.activeElement!==this.input||!isNew)&&(this.input.value=written(value)),isNew&&this.commit(value),this.input.value=written(this.value)}nudge(event,step){
event.key==="Enter"&&this.read();let sense={ArrowUp:1,ArrowDown:-1}[event.key];if(!sense||event.ctrlKey||event.metaKey)return;let{value,fault}=quantity(this.input.
value,this.options());fault||value===void 0||(event.preventDefault(),this.input.value=written(stepped(value,sense*stepOf(event,step))),this.read())}say(sentence2){
give(this.fault,"hidden",sentence2===null),say(this.fault,sentence2??""),sentence2===null?(this.input.removeAttribute("aria-invalid"),this.input.removeAttribute(
"aria-describedby")):(put(this.input,"aria-invalid","true"),put(this.input,"aria-describedby",this.fault.id))}},stepOf=(event,step)=>step*(event.shiftKey?10:event.
altKey?.1:1),stepped=(value,by)=>Number((value+by).toPrecision(12));var button=(text,onclick,attributes={})=>h("button",{type:"button",class:"bm-button",onclick,...attributes},text);var OFF=[16,20],HandleField=class{what=null;constructor(store,scene){this.store=store,this.scene=scene,this.element=h("div",{class:"bs-handle-field",role:"group",
hidden:!0}),scene.element.append(this.element),store.on("document selection",()=>this.draw()),scene.on("view",()=>this.draw()),scene.svg.addEventListener("point\
erdown",event=>scene.dragged||event.button===0&&this.close()),scene.svg.addEventListener("keydown",event=>this.begin(event)),this.element.addEventListener("keyd\
own",event=>{event.key!=="Escape"&&event.key!=="Enter"||(this.close(),scene.svg.focus({preventScroll:!0}),event.stopPropagation())})}open(what){this.what=what,this.
fields=what.fields.map(([key,label,kind])=>new NumberField({label:`${label} of ${what.name}`,commit:value=>what.set({[key]:value}),options:()=>({kind,unit:this.
store.document.length_unit,...what.options}),step:()=>kind==="angle"?1:this.scene.step,attributes:{"data-key":key,title:label}})),this.element.replaceChildren(...this.
fields.map((field,k)=>h("label",{},h("span",{},what.fields[k][1]),field.element))),this.element.setAttribute("aria-label",what.name),give(this.element,"hidden",
!1),this.draw()}close(){this.what&&(this.what=null,give(this.element,"hidden",!0))}draw(){let{what,store,scene:{view}}=this,at=what?.kind===store.selection?.kind&&
what?.at();if(!at)return this.close();let values=what.values(),width=this.element.offsetWidth,height=this.element.offsetHeight,[X,Y]=[view.X(at[0]),view.Y(at[1])];
this.fields.forEach((field,k)=>field.show(values[what.fields[k][0]])),this.element.style.left=`${X+OFF[0]+width>view.width?X-OFF[0]-width:X+OFF[0]}px`,this.element.
style.top=`${Math.max(0,Y+OFF[1]+height>view.height?Y-OFF[1]-height:Y+OFF[1])}px`}begin(event){if(!this.what||event.target===this.scene.svg||!/^[\d.,\-−]$/.test(
event.key)||event.ctrlKey||event.metaKey||event.altKey)return;let[{input}]=this.fields;input.focus(),input.select()}};var LETTER=7.2,HEIGHT=14,REST=80,MANY=60,OUTSIDE=500,HABIT=6,MISLEADING=60,SAME=2;function around(text,toward,distance,few=!1){let half=(LETTER*text.length+4)/2,
places=[],count=few?8:16;for(let ring=0;ring<(few?1:3);ring+=1)for(let k=0;k<count;k+=1){let turn=(k%2?1:-1)*Math.ceil(k/2)*(2*Math.PI/count),angle=toward+turn,
away=distance+9*ring;places.push([(away+half-5)*Math.cos(angle),away*Math.sin(angle),3*Math.abs(turn)+14*ring])}return places}function along(up,width){let reach=Math.
max(0,width/2-30);return[0,-.5,.5,-1,1].flatMap(share=>[[share*reach,up,8*Math.abs(share)],[share*reach,-up,10+8*Math.abs(share)]])}var NamePlaces=class{timer;constructor(scene){
this.scene=scene,this.names=new Map,this.obstacles=[],this.timer=null,scene.on("dropped",()=>this.ask())}avoid(fn){this.obstacles.push(fn)}get areMany(){return this.
names.size>MANY}put(element,x,y,text,places){let before=this.names.get(element),name={x,y,text,places,at:before?.text===text?before.at:places[0]};this.names.set(
element,name),this.show(element,name),this.ask()}ask(){clearTimeout(this.timer),this.scene.dragged||(this.timer=setTimeout(()=>this.place(),REST))}show(element,{
x,y,at}){put(element,"text-anchor","middle"),put(element,"transform",`translate(${px(x+at[0])} ${px(y-at[1]+4)})`)}place(){if(this.scene.dragged)return;for(let element of[
...this.names.keys()])element.isConnected||this.names.delete(element);let{width,height}=this.scene.view,seen2=[...this.names].filter(([element,{x,y}])=>x>-20&&y>
-20&&x<width+20&&y<height+20&&element.getAttribute("display")!=="none"),taken=this.obstacles.flatMap(fn=>fn()).map(boxOf),stands=new Map;for(let pass=0;pass<(this.
areMany?1:2);pass+=1)for(let[element,name]of seen2){stands.delete(element);let others=[...stands.values()],best={cost:1/0,at:name.at,box:[0,0,0,0]};for(let at of name.
places){let box=boxAt(name,at),habit=at[0]===name.at[0]&&at[1]===name.at[1]?HABIT:0,cost=at[2]-habit;(box[0]<2||box[1]<2||box[2]>width-2||box[3]>height-2)&&(cost+=
OUTSIDE);for(let other of taken)cost+=overlap(box,other);for(let other of others)cost+=SAME*overlap(box,other);let own=awayFrom(box,name);seen2.some(([,other])=>other!==
name&&awayFrom(box,other)<own+1)&&(cost+=MISLEADING),cost<best.cost&&(best={cost,at,box})}name.at=best.at,stands.set(element,best.box)}for(let[element,name]of seen2)
this.show(element,name)}},boxOf=([x,y,width,height])=>[x-width/2,y-height/2,x+width/2,y+height/2],boxAt=({x,y,text},at)=>boxOf([x+at[0],y-at[1],LETTER*text.length+
4,HEIGHT]),awayFrom=(box,{x,y})=>Math.hypot(Math.max(box[0]-x,0,x-box[2]),Math.max(box[1]-y,0,y-box[3]));function overlap(one,other){let across=Math.min(one[2],
other[2])-Math.max(one[0],other[0]),down=Math.min(one[3],other[3])-Math.max(one[1],other[1]);return across>0&&down>0?across*down:0}var cross=([a,b],[c,d])=>a*d-b*c,minus=([a,b],[c,d])=>[a-c,b-d],size=([a,b])=>Math.hypot(a,b);function fromSegment(point,start,end){let along2=minus(end,start),
away=minus(point,start),square=along2[0]**2+along2[1]**2,share=square>0?Math.min(1,Math.max(0,(along2[0]*away[0]+along2[1]*away[1])/square)):0;return size(minus(
away,[share*along2[0],share*along2[1]]))}var boxCorners=([[a,b],[c,d]])=>[[a,b],[c,b],[c,d],[a,d]],outlineOf=(shape,points)=>shape==="box"?boxCorners(points):points;
function isInside([x,y],corners){let inside=!1;return corners.forEach(([a,b],k)=>{let[c,d]=corners[(k+1)%corners.length];b>y!=d>y&&x<a+(y-b)/(d-b)*(c-a)&&(inside=
!inside)}),inside}function distanceTo(point,shape,points){if(shape==="point")return size(minus(point,points[0]));if(shape==="segment")return fromSegment(point,...points);
if(shape==="line"){let along2=minus(points[1],points[0]);return Math.abs(cross(along2,minus(point,points[0])))/size(along2)}let corners=outlineOf(shape,points);
return isInside(point,corners)?0:Math.min(...corners.map((corner,k)=>fromSegment(point,corner,corners[(k+1)%corners.length])))}var crosses=(a,b,c,d)=>{let turn=(p,q,r)=>Math.
sign(cross(minus(q,p),minus(r,p)));return turn(a,b,c)*turn(a,b,d)<0&&turn(c,d,a)*turn(c,d,b)<0},edges=corners=>corners.map((corner,k)=>[corner,corners[(k+1)%corners.
length]]);function overlap2(one,other){return isInside(one[0],other)||isInside(other[0],one)?!0:edges(one).some(([a,b])=>edges(other).some(([c,d])=>crosses(a,b,
c,d)))}function segmentFromPolygon([start,end],corners){return isInside(start,corners)||edges(corners).some(([c,d])=>crosses(start,end,c,d))?0:Math.min(...edges(
corners).map(([c,d])=>Math.min(fromSegment(start,c,d),fromSegment(end,c,d),fromSegment(c,start,end),fromSegment(d,start,end))))}var ROUNDING=1e-6,MOST_PLACES2=90,KEYS=["fixed_pivot","moving_pivot"];function currentLinkage(store){if(store.chosen==="placed")return store.placed?.linkage??null;
let followed=store.followed?.linkages.find(({id})=>id===store.chosen);return followed?.led?followed:store.followed?.vanished?.some(({id})=>id===store.chosen)?null:
store.solved?.linkages.find(({id})=>id===store.chosen)??null}var PIVOT={fixed_pivot:"fixed pivot",moving_pivot:"moving pivot"};function missed(table,dyad,slack){
let found=[];for(let key of KEYS){if(!table[key])continue;let[[shape,stated]]=Object.entries(table[key]),points=shape==="point"?[stated]:stated,away=dyad[key]?distanceTo(
dyad[key],shape,points):1/0;away>slack&&found.push({key,dyad:dyad.id,away})}let{least:least2=0,most=1/0}=table.length??{};return table.length&&dyad.kind==="RR"&&
(dyad.radius<least2-slack||dyad.radius>most+slack)&&found.push({key:"length",dyad:dyad.id,away:Math.max(least2-dyad.radius,dyad.radius-most)}),table.kinds&&!table.
kinds.includes(dyad.kind)&&found.push({key:"kinds",dyad:dyad.id,away:1/0}),found}function limitsMissed(document2,linkage,size2){let tables=limitsOf(document2),slack=ROUNDING*
size2,[one,other]=linkage.led;return tables.length<2?tables.map(table=>[...missed(table,one,slack),...missed(table,other,slack)]):limitedDyads(document2,linkage,
size2).map((dyad,k)=>missed(tables[k],dyad,slack))}function limitedDyads(document2,{led:[one,other]},size2){let tables=limitsOf(document2),slack=ROUNDING*size2,
[straight,crossed]=[[one,other],[other,one]].map(dyads=>tables.length>1&&dyads.flatMap((dyad,k)=>missed(tables[k],dyad,slack)).length);return crossed<straight?[
other,one]:[one,other]}function missedSentence({key,dyad,away},unit){let by=`${Number(away.toPrecision(2))}${unit?` ${unit}`:""}`;return key==="kinds"?`${dyad} \
is of another kind.`:key==="length"?`The link of ${dyad} is ${by} beyond its range.`:away===1/0?`${dyad} has no ${PIVOT[key]}.`:`The ${PIVOT[key]} of ${dyad} is\
 ${by} outside.`}function usedPlaces(linkage){let rows=(linkage.pose_errors??[]).filter(row=>row.way!==null&&row.frame!==null);if(!rows.length||!linkage.ways?.length)
return[];let counts=new Map;for(let{way:way2}of rows)counts.set(way2,(counts.get(way2)??0)+1);let[best]=[...counts].sort((a,b)=>b[1]-a[1])[0],way=linkage.ways[best],
frames=rows.filter(row=>row.way===best).map(({frame})=>frame),low=Math.floor(Math.min(...frames)),high=Math.ceil(Math.max(...frames)),stride=Math.max(1,Math.ceil(
(high-low)/MOST_PLACES2)),places=[];for(let k=low;k<=high&&k<way.x.length;k+=stride)places.push({x:way.x[k],y:way.y[k],a:way.angle[k]});return places}var regionCorners=region=>region.
polygon??(region.box?boxCorners(region.box):null),seen=(body,place)=>body.map(corner=>act(place,corner));function posePlace(document2,k){let{x,y,angle}=standing(
document2,k);return{x,y,a:radians(angle)}}function regionsTouched(document2,linkage,body){let places=usedPlaces(linkage),width=document2.surroundings?.link_width??
0,margin=document2.surroundings?.margin??0,apart=Math.ceil(document2.poses.length/MOST_PLACES2),some=[...document2.poses.keys()].filter(k=>k%apart===0);return regionsOf(
document2).map(region=>{let corners=regionCorners(region);if(!corners)return"";let pose=body.length>2?some.find(k=>overlap2(seen(body,posePlace(document2,k)),corners)):
void 0;if(pose!==void 0)return`The body touches it at pose ${poseName2(document2,pose)}.`;if(!places.length)return"";if(body.length>2&&places.some(place=>overlap2(
seen(body,place),corners)))return"The body touches it.";for(let dyad of linkage.led){if(dyad.kind!=="RR")continue;let near2=Math.min(...places.map(place=>segmentFromPolygon(
[dyad.fixed_pivot,act(place,dyad.moving_pivot)],corners)));if(near2===0||near2<width/2)return`The link of ${dyad.id} touches it.`;if(near2<width/2+margin)return`\
The link of ${dyad.id} comes nearer than the margin.`}return""})}var POINT=9,LINE=6,GRID=4,FINER=5,STEP=15,NEAR=2.2,PARALLEL=1,MOST=40,tenths=angle=>Number(angle.toFixed(1))+0,Snapping=class{isOn=!0;constructor(store,scene){this.
store=store,this.scene=scene,this.text=s("text",{class:"bs-snap-name"}),this.mark=s("path",{class:"bs-snap-mark"}),this.element=s("g",{class:"bs-snap","aria-hid\
den":"true"},this.mark,this.text);for(let name of["dropped","tool"])scene.on(name,()=>this.clear())}clear(){this.element.remove()}show(point,name){let[x,y]=point,
{view}=this.scene,X=view.X(x),Y=view.Y(y);put(this.mark,"d",`M${px(X)} ${px(Y)}m-7 0h14m-7 -7v14`),put(this.text,"x",px(X+10)),put(this.text,"y",px(Y-10)),say(this.
text,name),this.scene.layer("tool").append(this.element)}place(k){let{x,y,angle}=standing(this.store.document,k);return{x,y,a:radians(angle)}}targets(){let{store}=this,
{document:document2}=store,poses=[...document2.poses.keys()].slice(0,MOST),points=[],lines=[],corners=(list,name,of,place={x:0,y:0,a:0})=>points.push(...list.map(
point=>({at:act(place,point),name:`corner of ${name}`,of,isStated:!place.x&&!place.y&&!place.a})));for(let dyad of currentLinkage(store)?.led??[])dyad.fixed_pivot&&
points.push({at:dyad.fixed_pivot,name:`fixed pivot of ${dyad.id}`,of:"linkage"}),dyad.moving_pivot&&poses.length&&points.push({at:act(this.place(store.referenceIndex),
dyad.moving_pivot),name:`moving pivot of ${dyad.id}`,of:"linkage"});regionsOf(document2).forEach((region,k)=>(region.box||region.polygon)&&corners(region.polygon??
outlineOf("box",region.box),region.name??`region ${k+1}`,`region ${k}`)),limitRegions(document2).forEach(({key,shape,points:list},k)=>key==="fixed_pivot"&&corners(
outlineOf(shape,list),"the limit",`limit ${k}`));for(let k of poses){let{x,y,a}=this.place(k),name=`pose ${poseName2(document2,k)}`,of=`pose ${k}`;if(points.push(
{at:[x,y],name,of,isStated:!0}),document2.poses[k].angle!==void 0)for(let turn of[0,90])lines.push({at:[x,y],along:[Math.cos(a+radians(turn)),Math.sin(a+radians(
turn))],name:`${turn?"y":"x"} axis of ${name}`,of});corners(bodyOf(document2),`the body at ${name}`,`body ${of}`,{x,y,a})}return{points,lines}}point([x,y],{event,
from=null,skip=()=>!1}={}){let{scene}=this,{scale}=scene.view,rounded=pair=>pair.map(value=>scene.rounded(value));if(this.clear(),event?.shiftKey&&from){let across=Math.
abs(x-from[0])>=Math.abs(y-from[1]),at2=across?[scene.rounded(x),from[1]]:[from[0],scene.rounded(y)];return this.show(at2,across?"horizontal":"vertical"),at2}if(!this.
isOn||event?.altKey)return rounded([x,y]);let{points,lines}=this.targets(),away=({at:at2,along:along2})=>scale*(along2?Math.abs((x-at2[0])*along2[1]-(y-at2[1])*
along2[0]):Math.hypot(x-at2[0],y-at2[1])),nearest=(list,most)=>list.filter(({of})=>!skip(of)).map(each=>({...each,away:away(each)})).filter(each=>each.away<most).
sort((a,b)=>a.away-b.away)[0],onPoint=nearest(points,POINT),onLine=onPoint?null:nearest(lines,LINE);if(onPoint)return this.show(onPoint.at,onPoint.name),onPoint.
isStated?onPoint.at:rounded(onPoint.at);if(onLine){let{at:at2,along:along2}=onLine,share=(x-at2[0])*along2[0]+(y-at2[1])*along2[1],foot2=[at2[0]+share*along2[0],
at2[1]+share*along2[1]];return this.show(foot2,onLine.name),rounded(foot2)}let step=this.gridStep,found=[x,y].map(value=>{let line=Number((Math.round(value/step)*
step).toPrecision(12));return scale*Math.abs(line-value)<GRID?line:null}),at=rounded([x,y]).map((value,k)=>found[k]??value);return found.some(value=>value!==null)&&
this.show(at,found.includes(null)?`grid, ${found[0]===null?"y":"x"} ${found[0]??found[1]}`:"grid"),at}get gridStep(){let{view}=this.scene,[one,other]=ticks(view.
x(0),view.x(view.width),view.width/110);return(other?other.at-one.at:10**Math.round(Math.log10(100/view.scale)))/FINER}angle(angle,at,{event,skip=-1}){this.clear();
let step=STEP*Math.round(angle/STEP);if(event?.altKey||!this.isOn&&!event?.shiftKey)return tenths(angle);if(event?.shiftKey||Math.abs(step-angle)<NEAR)return this.
show(at,`${step}°`),step;let{document:document2}=this.store,off=pose=>Math.abs((pose.angle-angle+540)%360-180),k=document2.poses.slice(0,MOST).findIndex((pose,k2)=>k2!==
skip&&pose.angle!==void 0&&off(pose)<PARALLEL);if(k<0)return tenths(angle);let same=document2.poses[k].angle;return this.show(at,`parallel to pose ${poseName2(document2,
k)}`),same+360*Math.round((angle-same)/360)}};var LAYERS=["grid","regions","ghosts","map","curves","paths","mechanism","limits","pivots","poses","labels","tool"],MARGIN=46,ZOOM=1.0018,WIDEST2=1e6,CLICK=4,RAW=8,
Scene=class{view;pressed=null;field;constructor(store,{zoomKey=!1}={}){this.store=store,this.zoomKey=zoomKey,this.listeners={view:[],click:[],tool:[],dropped:[],
closer:[],marquee:[],key:[]},this.tool=null,this.dragged=null,this.layers=new Map(LAYERS.map(name=>[name,s("g",{class:`bs-layer bs-layer-${name}`})])),this.layers.
get("grid").setAttribute("aria-hidden","true"),this.svg=s("svg",{class:"bs-scene",tabindex:0,role:"group","aria-label":"The plane: poses, linkage and limits. Ar\
row keys pan, plus and minus zoom, 0 fits."},...this.layers.values()),this.element=h("div",{class:"bs-plane"},this.svg),this.size={width:640,height:480},this.origin=
{scale:1,left:320,top:240},this.isFitted=!0,this.pointers=new Map,this.boxes=[],this.names=new NamePlaces(this),this.marquee=s("rect",{class:"bs-marquee"}),this.
snap=new Snapping(store,this),this.update(),this.listen(),this.field=new HandleField(store,this),store.on("document",()=>this.unit===store.document.length_unit||
this.grid()),new ResizeObserver(()=>this.resize()).observe(this.element),addEventListener("scroll",()=>this.box=null,{capture:!0,passive:!0})}layer(name){return this.
layers.get(name)}on(name,fn){this.listeners[name].push(fn)}emit(name,...values){return this.listeners[name].map(fn=>fn(...values)).some(Boolean)}hold(fn,far=!1){
this.boxes.push({fn,far})}update(){let{width,height}=this.size,{scale,left,top}=this.origin;this.view={scale,left,top,width,height,X:x=>left+scale*x,Y:y=>top-scale*
y,x:X=>(X-left)/scale,y:Y=>(top-Y)/scale},Object.assign(this.svg.dataset,{scale,left,top,fit:this.isFitted?this.isWhole?"all":"near":""}),this.grid(),this.emit(
"view",this.view)}resize(){this.box=null;let{width,height}=this.svg.getBoundingClientRect();!width||!height||width===this.size.width&&height===this.size.height||
(this.origin={...this.origin,left:this.origin.left+(width-this.size.width)/2,top:this.origin.top+(height-this.size.height)/2},this.size={width,height},put(this.
svg,"viewBox",`0 0 ${width} ${height}`),this.isFitted?this.fit(this.isWhole):this.update())}pan(dx,dy){this.isFitted=!1,this.origin={...this.origin,left:this.origin.
left+dx,top:this.origin.top+dy},this.update()}zoom(factor,X,Y){let fitted2=this.fittedScale??this.origin.scale,scale=clamp(this.origin.scale*factor,fitted2/WIDEST2,
fitted2*WIDEST2),by=scale/this.origin.scale;this.isFitted=!1,this.origin={scale,left:X+by*(this.origin.left-X),top:Y+by*(this.origin.top-Y)},this.update()}fit(whole=!1){
let pointsOf=isFar=>this.boxes.filter(({far})=>far===isFar).flatMap(({fn})=>fn());this.isWhole=whole,this.isFitted=!0,this.fitBox(fitted(pointsOf(!1),pointsOf(!0),
whole))}fitBox(box){let[x,y,u,v]=Number.isFinite(box[0])?box:[-50,-50,50,50],size2=.1*(Math.max(u-x,v-y)||Math.max(1,Math.abs(u),Math.abs(v))),{width,height}=this.
size,wide=Math.max(0,size2-u+x)/2,high=Math.max(0,size2-v+y)/2,{scale,left,top}=viewOf([x-wide,y-high,u+wide,v+high],width,height,Math.min(MARGIN,width/8));this.
fittedScale=scale,this.origin={scale,left,top},this.update()}fitAgain(){this.fit(this.isFitted&&!this.isWhole)}closeUp(points){this.isFitted=!1,this.fitBox(bounds(
points))}reveal(point){let{view}=this,margin=Math.min(MARGIN,view.width/8);this.closeUp([point,[view.x(margin),view.y(margin)],[view.x(view.width-margin),view.y(
view.height-margin)]])}grid(){let{view}=this,{width,height}=view,group=this.layer("grid"),name=this.unit=this.store.document.length_unit,unit=name?` ${name}`:"",
across=ticks(view.x(0),view.x(width),width/110),up=ticks(view.y(height),view.y(0),height/80),lines=[...across.map(({at})=>`M${px(view.X(at))} 0V${height}`),...up.
map(({at})=>`M0 ${px(view.Y(at))}H${width}`)],origin=`M${px(clamp(view.X(0),-9,width+9))} 0V${height}M0 ${px(clamp(view.Y(0),-9,height+9))}H${width}`;group.replaceChildren(
s("path",{class:"bs-grid-line",d:lines.join("")}),s("path",{class:"bs-grid-axis",d:origin}),...across.filter(({at})=>view.X(at)>46&&view.X(at)<width-(unit?54:30)).
map(({at,text})=>s("text",{x:px(view.X(at)),y:height-6,"text-anchor":"middle"},text)),...up.filter(({at})=>view.Y(at)>30&&view.Y(at)<height-24).map(({at,text})=>s(
"text",{x:6,y:px(view.Y(at)-4)},text)),s("text",{x:6,y:14},`y${unit}`),s("text",{x:width-6,y:height-6,"text-anchor":"end"},`x${unit}`))}get grain(){return 10**Math.
floor(Math.log10(.35/this.view.scale))}rounded(value){let{grain}=this,digits=clamp(-Math.round(Math.log10(grain)),0,12);return Number((Math.round(value/grain)*grain).
toFixed(digits))+0}get step(){let[x,y,u,v]=bounds(this.store.document.poses.map(pose=>[pose.x??0,pose.y??0])),span=Math.hypot(u-x,v-y);return Number.isFinite(span)&&
span>0?10**Math.floor(Math.log10(span/50)):1}at(event){this.box||(this.box=this.svg.getBoundingClientRect(),this.dragged||requestAnimationFrame(()=>this.dragged||
(this.box=null)));let{left,top}=this.box,X=event.clientX-left,Y=event.clientY-top;return{X,Y,x:this.view.x(X),y:this.view.y(Y)}}drag(element,{start=()=>!0,move,
end=()=>{},cancel=()=>{},click=()=>{}}){element.addEventListener("pointerdown",event=>{if(event.button!==0||this.tool||this.dragged)return;event.preventDefault(),
event.stopPropagation(),this.pressed=event,element.focus?.({preventScroll:!0}),this.pressed=null;let from=this.at(event),ended=new AbortController,{signal}=ended,
begun=!1,stop=finish=>{ended.abort(),this.dragged=this.box=null,this.svg.classList.remove("bs-grasped"),this.svg.hasPointerCapture?.(event.pointerId)&&this.svg.
releasePointerCapture(event.pointerId),finish(),this.emit("dropped")};this.dragged={cancel:()=>stop(()=>begun&&cancel())},this.capture(event);let on=(name,fn)=>this.
svg.addEventListener(name,each=>each.pointerId===event.pointerId&&fn(each),{signal}),last=from,then=event.timeStamp,go=each=>{let point=this.at(each);if(!(point.
X===last.X&&point.Y===last.Y)){if(last=point,then=each.timeStamp,!begun){if(Math.hypot(point.X-from.X,point.Y-from.Y)<CLICK)return;if(begun=start(from,event)!==
!1,!begun)return stop(()=>{});this.svg.classList.add("bs-grasped")}move(point,each)}};on("pointermove",go),on("pointerrawupdate",each=>each.timeStamp-then>=RAW&&
go(each)),on("pointerup",each=>stop(()=>begun?end(this.at(each)):click(event))),on("pointercancel",()=>stop(()=>begun&&cancel()))})}use(tool){let before=this.tool;
this.tool=tool??null,before?.end?.(),this.svg.classList.toggle("bs-drawing",!!tool),this.emit("tool",this.tool),tool&&this.svg.focus({preventScroll:!0})}listen(){
let{svg}=this;svg.addEventListener("wheel",event=>{if(this.zoomKey&&!event.ctrlKey&&!event.metaKey)return;event.preventDefault();let{X,Y}=this.at(event),unit=event.
deltaMode===1?16:1;this.zoom(ZOOM**(-event.deltaY*unit*(event.ctrlKey&&!this.zoomKey?4:1)),X,Y)},{passive:!1}),svg.addEventListener("pointerdown",event=>this.press(
event)),svg.addEventListener("pointermove",event=>this.moved(event));for(let name of["pointerup","pointercancel"])svg.addEventListener(name,event=>this.released(
event));svg.addEventListener("keydown",event=>this.key(event))}capture({pointerId}){try{this.svg.setPointerCapture(pointerId)}catch{}}press(event){if(event.button!==
0&&event.button!==1)return;let{X,Y}=this.at(event);if(this.pointers.set(event.pointerId,{X,Y,from:{X,Y},button:event.button,isMarquee:event.shiftKey&&!this.tool}),
this.pointers.size>1)for(let each of this.pointers.values())each.panned=!0;this.capture(event)}moved(event){let point=this.at(event),held=this.pointers.get(event.
pointerId);if(!held){this.dragged||this.tool?.hover?.(point,event);return}let before={X:held.X,Y:held.Y};if(Object.assign(held,{X:point.X,Y:point.Y}),this.pointers.
size===2){let[one,other]=this.pointers.values(),still=held===one?other:one,[now,then]=[point,before].map(({X,Y})=>Math.hypot(X-still.X,Y-still.Y));then>0&&this.
zoom(now/then,(point.X+still.X)/2,(point.Y+still.Y)/2);return}if(held.panned||=Math.hypot(point.X-held.from.X,point.Y-held.from.Y)>CLICK,!!held.panned){if(held.
isMarquee)return void this.stretch(held);this.tool?.drag?.(point,held,event)||(this.svg.classList.add("bs-grasped"),this.pan(point.X-before.X,point.Y-before.Y))}}released(event){
let held=this.pointers.get(event.pointerId);if(!held)return;this.pointers.delete(event.pointerId),this.svg.classList.remove("bs-grasped");let point=this.at(event);
event.type==="pointercancel"?this.tool?.hover?.(null):held.panned&&held.isMarquee?this.caught(held):held.panned?this.tool?.release?.(point,held):held.button===0&&
(this.tool?this.tool.click(point,event):this.emit("click",point,event))}stretch({X,Y,from}){for(let[key,value]of Object.entries({x:Math.min(X,from.X),y:Math.min(
Y,from.Y),width:Math.abs(X-from.X),height:Math.abs(Y-from.Y)}))put(this.marquee,key,value);this.layer("tool").append(this.marquee)}caught({X,Y,from}){let{view}=this;
this.marquee.remove(),this.emit("marquee",bounds([[view.x(X),view.y(Y)],[view.x(from.X),view.y(from.Y)]]))}key(event){if(event.target!==this.svg||event.ctrlKey||
event.metaKey||this.emit("key",event)||event.altKey)return;let by=event.shiftKey?160:40,{width,height}=this.size,steps={ArrowLeft:[by,0],ArrowRight:[-by,0],ArrowUp:[
0,by],ArrowDown:[0,-by]};if(steps[event.key])this.pan(...steps[event.key]);else if(event.key==="+"||event.key==="=")this.zoom(1.25,width/2,height/2);else if(event.
key==="-")this.zoom(.8,width/2,height/2);else if(event.key==="0")this.fitAgain();else if(event.key==="z")this.emit("closer");else return;event.preventDefault()}},
Kept=class{constructor(group,make,show){this.group=group,this.make=make,this.show=show,this.elements=new Map}draw(items){let kept=new Map;for(let[key,item]of items){
let element=this.elements.get(key)??this.make(key,item);kept.set(key,element),this.show(element,item)}for(let[key,element]of this.elements)kept.has(key)||element.
remove();let before=null;for(let element of kept.values()){let next=before?before.nextSibling:this.group.firstChild;(element!==next||element.parentNode!==this.group)&&
this.group.insertBefore(element,next),before=element}this.elements=kept}};var ARROWS={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},LEAST_CORNERS=3,CLOSED=new Set(["box","polygon"]),GROUND={x:0,y:0,a:0};function pathOf(shape,points,place,view){
let seen2=outlineOf(shape,points).map(point=>act(place,point)).map(([x,y])=>[view.X(x),view.Y(y)]);if(shape==="point")return`M${px(seen2[0][0]-7)} ${px(seen2[0][1])}\
h14m-7 -7v14`;if(shape==="line"){let[[a,b],[c,d]]=seen2,size2=Math.hypot(c-a,d-b)||1,far=view.width+view.height+Math.hypot(a,b),[u,v]=[far*(c-a)/size2,far*(d-b)/
size2];return`M${px(a-u)} ${px(b-v)}L${px(c+u)} ${px(d+v)}`}return`M${seen2.map(point=>point.map(px).join(" ")).join("L")}${CLOSED.has(shape)?"Z":""}`}function withCorner(shape,points,k,to){
if(shape!=="box")return points.map((point,i)=>i===k?to:point);let opposite=boxCorners(points)[(k+2)%4];return[[Math.min(to[0],opposite[0]),Math.min(to[1],opposite[1])],
[Math.max(to[0],opposite[0]),Math.max(to[1],opposite[1])]]}var ShapeHandles=class{constructor(scene,{what,set,remove,select,abandon,className=""}){this.scene=scene,
this.what=what,this.set=set,this.remove=remove,this.select=select,this.abandon=abandon,this.title=s("title"),this.area=s("path",{class:"bs-shape-area",tabindex:0,
role:"button"},this.title),this.line=s("path",{class:"bs-shape-line"}),this.element=s("g",{class:`bs-shape ${className}`},this.line,this.area),this.middles=new Kept(
s("g"),(key,k)=>this.makeMiddle(k),(element,k)=>this.showMiddle(element,k)),this.corners=new Kept(s("g"),(key,k)=>this.makeCorner(k),(element,k)=>this.showCorner(
element,k)),this.handles=s("g",{class:"bs-corners"},this.middles.group,this.corners.group),this.dragWhole(),this.area.addEventListener("focus",()=>this.select()),
this.area.addEventListener("keydown",event=>this.keys(event,(points,by)=>points.map(([x,y])=>[stepped(x,by[0]),stepped(y,by[1])]),()=>this.remove()))}draw(){let{
shape,points,place,name,selected,state,data}=this.now=this.what(),d=pathOf(shape,points,place,this.scene.view);put(this.line,"d",d),put(this.area,"d",d),this.area.
classList.toggle("bs-open",!CLOSED.has(shape)),put(this.area,"aria-label",`${name}${state?`, ${state} by the chosen linkage`:""}. Drag, or use the arrow keys; D\
elete removes it.`),put(this.area,"aria-pressed",!!selected),say(this.title,name);for(let[key2,value2]of Object.entries({...data,shape}))put(this.element,`data-${key2}`,
value2);this.element.classList.toggle("bs-selected",!!selected),this.element.classList.toggle("bs-met",state==="met"),this.element.classList.toggle("bs-broken",
state==="broken");let[[key,value]]=Object.entries(data);put(this.handles,"data-handles",`${key} ${value}`.trim()),this.handles.parentNode||this.scene.layer("too\
l").append(this.handles);let count=selected?outlineOf(shape,points).length:0,edges2=shape==="polygon"?count:0;this.corners.draw([...Array(count).keys()].map(k=>[
k,k])),this.middles.draw([...Array(edges2).keys()].map(k=>[k,k]))}clear(){this.element.remove(),this.handles.remove()}at([x,y]){let[u,v]=act(this.now.place,[x,y]);
return{cx:px(this.scene.view.X(u)),cy:px(this.scene.view.Y(v))}}point({x,y},event,from){let{place}=this.now,of=this.handles.dataset.handles??"",at=this.scene.snap.
point([x,y],{event,from:from&&act(place,from),skip:each=>each.startsWith(of)});return this.inFrame(at)}inFrame(at){let{place}=this.now;return place.x||place.y||
place.a?back(place,at).map(each=>this.scene.rounded(each)):at}openField(k){let{now:{name,place}}=this,corner=()=>outlineOf(this.now.shape,this.now.points)[k];this.
scene.field.open({name:`corner ${k+1} of ${name}`,kind:this.scene.store.selection?.kind,fields:[["x","x","length"],["y","y","length"]],at:()=>corner()&&this.element.
isConnected&&act(place,corner()),values:()=>({x:corner()[0],y:corner()[1]}),set:({x=corner()[0],y=corner()[1]})=>this.set(withCorner(this.now.shape,this.now.points,
k,[x,y]),null)})}dragWhole(){let gesture,off,before,corner;this.scene.drag(this.area,{start:point=>{let away=each=>Math.hypot(...act(this.now.place,each).map((value,k)=>value-
[point.x,point.y][k]));gesture=Symbol("move a shape"),before=this.now.points,corner=before.reduce((one,other)=>away(other)<away(one)?other:one);let[x,y]=act(this.
now.place,corner);off=[x-point.x,y-point.y]},move:(point,event)=>{let to=this.point({x:point.x+off[0],y:point.y+off[1]},event,corner),by=[to[0]-corner[0],to[1]-
corner[1]];this.set(before.map(([x,y])=>[stepped(x,by[0]),stepped(y,by[1])]),gesture)},cancel:()=>this.abandon(gesture),click:()=>this.select()})}makeCorner(k){
let circle=s("circle",{class:"bs-corner",r:6,tabindex:0,role:"button","data-corner":k+1}),gesture,from;return this.scene.drag(circle,{start:()=>{gesture=Symbol(
"move a corner"),from=outlineOf(this.now.shape,this.now.points)[k],this.openField(k)},move:(point,event)=>this.set(withCorner(this.now.shape,this.now.points,k,this.
point(point,event,from)),gesture),cancel:()=>this.abandon(gesture),click:()=>this.openField(k)}),circle.addEventListener("keydown",event=>this.keys(event,(points,by)=>{
let[x,y]=outlineOf(this.now.shape,points)[k];return withCorner(this.now.shape,points,k,[stepped(x,by[0]),stepped(y,by[1])])},()=>this.removeCorner(k))),circle}removeCorner(k){
let{shape,points}=this.now;shape!=="polygon"||points.length<=LEAST_CORNERS||this.set(points.filter((_,i)=>i!==k),null)}makeMiddle(k){let circle=s("circle",{class:"\
bs-middle",r:4.5,"data-edge":k+1}),gesture;return this.scene.drag(circle,{start:()=>{gesture=Symbol("add a corner"),this.set([...this.now.points.slice(0,k+1),this.
now.points[k],...this.now.points.slice(k+1)],gesture)},move:(point,event)=>this.set(withCorner("polygon",this.now.points,k+1,this.point(point,event)),gesture),cancel:()=>this.
abandon(gesture)}),circle}showCorner(element,k){let corner=outlineOf(this.now.shape,this.now.points)[k];for(let[name,value]of Object.entries(this.at(corner)))put(
element,name,value);put(element,"aria-label",`Corner ${k+1} of ${this.now.name}: ${corner.join(", ")}`)}showMiddle(element,k){let{points}=this.now,next=points[(k+
1)%points.length],middle2=this.at([(points[k][0]+next[0])/2,(points[k][1]+next[1])/2]);for(let[name,value]of Object.entries(middle2))put(element,name,value)}keys(event,moved2,remove){
if(event.ctrlKey||event.metaKey)return;let arrow2=ARROWS[event.key];if(arrow2){event.repeat||(this.keyed=Symbol("keys"));let by=stepOf(event,this.scene.step);this.
set(moved2(this.now.points,[by*arrow2[0],by*arrow2[1]]),this.keyed)}else if(event.key==="Delete"||event.key==="Backspace")remove();else return;event.preventDefault(),
event.stopPropagation()}};var CLOSE=12,PAIRS=new Set(["segment","line","box"]),HINTS={point:"Click the point. Enter puts it in the middle, Escape gives up.",segment:"Click both ends. Ent\
er puts one in the middle, Escape gives up.",line:"Click two points of the line. Enter puts one in the middle, Escape gives up.",box:"Drag from corner to corner\
, or click both. Enter puts one in the middle, Escape gives up.",polygon:"Click the corners; Enter or a click on the first one closes. Backspace takes the last \
one back, Escape gives up."},MIDDLE={point:[[0,0]],segment:[[-1,0],[1,0]],line:[[-1,0],[1,0]],box:[[-1,-1],[1,1]],polygon:[[-1,-1],[1,-1],[0,1]]},SHARE=.12,ordered=([
[a,b],[c,d]])=>[[Math.min(a,c),Math.min(b,d)],[Math.max(a,c),Math.max(b,d)]],isFlat=([[a,b],[c,d]])=>a===c&&b===d,ShapeTool=class{constructor(scene,{shape,place,
done,name,at=""}){this.scene=scene,this.shape=shape,this.place=place,this.done=done,this.name=name,this.points=[],this.next=null,this.hint=at?`${at}. ${HINTS[shape]}`:
HINTS[shape],this.isOfBody=!!at,this.path=s("path",{class:"bs-draft"}),this.dots=s("g"),this.element=s("g",{},this.path,this.dots),scene.layer("tool").append(this.
element)}point({x,y},event){let place=this.place(),last=this.points.at(-1),at=this.scene.snap.point([x,y],{event,from:last&&act(place,last)});return place.x||place.
y||place.a?back(place,at).map(each=>this.scene.rounded(each)):at}click(point,event){let next=this.point(point,event);if(this.shape==="polygon"){if(this.points.length>
2&&(this.isFirst(point)||event?.detail>1))return this.finish(this.points);if(this.points.length&&isFlat([this.points.at(-1),next]))return}return this.points.push(
next),this.shape==="point"||PAIRS.has(this.shape)&&this.points.length===2?this.finish(this.points):this.draw()}isFirst({X,Y}){let[x,y]=act(this.place(),this.points[0]),
{view}=this.scene;return Math.hypot(view.X(x)-X,view.Y(y)-Y)<CLOSE}hover(point,event){this.next=point&&this.point(point,event),this.draw()}drag(point,held,event){
return!PAIRS.has(this.shape)||this.points.length?!1:(this.dragging=[this.point(this.inPlane(held.from),event),this.point(point,event)],this.draw(),!0)}inPlane({
X,Y}){return{x:this.scene.view.x(X),y:this.scene.view.y(Y)}}inMiddle(){let{width,height}=this.scene.size,half=SHARE*Math.min(width,height);return MIDDLE[this.shape].
map(([x,y])=>this.point(this.inPlane({X:width/2+half*x,Y:height/2-half*y})))}release(){if(!this.dragging)return;let pair=this.dragging;this.dragging=null,this.finish(
pair)}finish(points){return PAIRS.has(this.shape)&&isFlat(points)?(this.points=points.slice(0,1),this.draw()):(this.scene.use(null),this.done(this.shape==="box"?
ordered(points):points))}key(event){if(event.key==="Escape")this.scene.use(null);else if(event.key==="Backspace")this.points.pop();else if(event.key==="Enter"&&
!this.points.length)this.finish(this.inMiddle());else if(event.key==="Enter"&&this.points.length>2)this.finish(this.points);else return!1;return this.draw(),!0}draw(){
let{scene:{view},shape}=this,shown2=this.dragging??[...this.points,...this.next?[this.next]:[]],place=this.place(),whole=shape==="polygon"?"open polygon":shape,
complete=shown2.length>1||shape==="point";put(this.path,"d",complete&&shown2.length?pathOf(whole,shown2,place,view):""),this.dots.replaceChildren(...(this.dragging??
this.points).map(point=>act(place,point)).map(([x,y],k)=>s("circle",{class:k?"bs-draft-dot":"bs-draft-dot bs-first",r:4,cx:px(view.X(x)),cy:px(view.Y(y))})))}end(){
this.element.remove()}};var PALEST=.4;function referencePlace(store){let k=store.referenceIndex;if(k<0)return{x:0,y:0,a:0};let{x,y,angle}=standing(store.document,k);return{x,y,a:radians(
angle)}}var atReference=store=>`Drawn at pose ${poseName2(store.document,Math.max(0,store.referenceIndex))}`,BodyEditor=class{constructor(store,scene){this.store=
store,this.scene=scene,this.ghosts=new Kept(s("g",{class:"bs-ghosts","aria-hidden":"true"}),()=>s("path",{class:"bs-ghost"}),(path,item)=>this.showGhost(path,item)),
scene.layer("ghosts").append(this.ghosts.group),this.handles=new ShapeHandles(scene,{className:"bs-body-shape",what:()=>({shape:"polygon",points:bodyOf(store.document),
place:referencePlace(store),name:"Outline of the body",selected:store.selection?.kind==="body",data:{body:""}}),set:(points,gesture)=>store.edit(document2=>setBody(
document2,points),{gesture}),remove:()=>store.edit(document2=>setBody(document2,[])),select:()=>store.select({kind:"body",index:0}),abandon:gesture=>store.abandon(
gesture)}),store.on("document selection reference",()=>this.draw()),scene.on("view",()=>this.draw()),store.on("document selection",()=>this.watch()),scene.on("t\
ool",()=>this.watch()),this.draw()}watch(){let{store,scene}=this,{selection,document:document2}=store,isOfBody=selection?.kind==="body"||selection?.kind==="limi\
t"&&limitRegions(document2)[selection.index]?.key==="moving_pivot",isOn=!!(scene.tool?.isOfBody||isOfBody);isOn!==store.isOnBody&&(store.isOnBody=isOn,scene.svg.
classList.toggle("bs-on-body",isOn),store.emit("reference"))}indices(){let{document:{poses},selectedPoses,referenceIndex}=this.store;return poses.map((_,k)=>k).
filter(k=>hasGhost(k,poses.length)||selectedPoses.includes(k)||k===referenceIndex&&this.store.isOnBody)}draw(){let body=bodyOf(this.store.document),{scale}=this.
scene.view;return this.path=body.length?`M${body.map(([x,y])=>`${px(scale*x)} ${px(-scale*y)}`).join("L")}Z`:"",this.ghosts.draw(body.length?this.indices().map(
k=>[k,k]):[]),!body.length||!this.store.document.poses.length?this.handles.clear():(this.handles.element.parentNode||this.scene.layer("ghosts").append(this.handles.
element),this.handles.draw())}showGhost(path,k){let{view}=this.scene,{x,y,angle}=standing(this.store.document,k),last=Math.max(1,this.store.document.poses.length-
1);path.classList.toggle("bs-reference",k===this.store.referenceIndex),isOther(path,[view,x,y,angle,k/last,this.path])&&(put(path,"d",this.path),put(path,"opaci\
ty",(PALEST+(1-PALEST)*k/last).toFixed(3)),put(path,"transform",transform(view.X(x),view.Y(y),radians(angle))))}tool(){return new ShapeTool(this.scene,{shape:"p\
olygon",name:"body",place:()=>referencePlace(this.store),at:atReference(this.store),done:points=>{this.store.edit(document2=>setBody(document2,points)),this.store.
select({kind:"body",index:0})}})}};var TYPED_IN="button, input, select, textarea, summary, a, [role=button], [role=slider]",written2=element=>element?.matches?.("input:not([type=checkbox]):not([t\
ype=radio]):not([type=range]), textarea");function listenToKeys(store,scene,files=null,root=document){let acts=event=>({z:()=>event.shiftKey?store.redo():store.
undo(),y:()=>store.redo(),...files&&{s:()=>files.save(),o:()=>files.chooser.click()}});root.addEventListener("keydown",event=>{let{key,target}=event;if((event.ctrlKey||
event.metaKey)&&!event.altKey){let act2=acts(event)[key.toLowerCase()];if(!act2||written2(target)&&target.dataset.typing==="true"&&/^[zy]$/i.test(key))return;event.
preventDefault(),act2()}else scene.dragged&&key==="Escape"?(event.preventDefault(),scene.dragged.cancel()):scene.tool&&!written2(target)&&scene.tool.key(event)?
(event.preventDefault(),event.stopPropagation()):key==="Escape"&&!written2(target)&&store.selection&&store.select(null)},!0),root.addEventListener("input",({target})=>target instanceof
HTMLElement&&(target.dataset.typing="true"));for(let name of["change","focusout"])root.addEventListener(name,({target})=>target instanceof HTMLElement&&delete target.
dataset.typing)}function listenToSpace({player},root=document){root.addEventListener("keydown",event=>{event.key!==" "||event.ctrlKey||event.metaKey||event.altKey||
event.target instanceof Element&&event.target.closest(TYPED_IN)||!player.path||(event.preventDefault(),player.play(!player.playing))})}var BODY_AXIS=AXIS+10,LETTER2=14,TURNING_ARROW="M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9",BLOCK_IN_SLOT=[18,10],SPARE2=5,NAME=15,ARROW=24;var Mechanism=class{constructor({led,drawn:links=[],ground,names}){this.kinds=kindsOf(led),this.outline=s("path",{class:"bm-body-outline"}),this.links=s("g"),this.
blocks=s("g"),this.pins=s("g"),this.coupler=s("g",{class:"bm-coupler"}),this.arrow=s("path",{class:"bm-drive-mark bm-side0"}),this.letter=s("text",{class:"bm-le\
tter","text-anchor":"middle"},"M"),this.plates=[s("path",{class:"bm-plate-rim"}),s("path",{class:"bm-plate"})],this.coupler.append(...this.plates),this.parts=led.
map((dyad,side)=>new PARTS[dyad.kind](this,side)),links.length&&this.parts.push(...links.map(link=>new JointedLink(this,link)),new Joints(this,ground,names)),this.
coupler.append(s("path",{class:"bm-body-frame",d:axes(BODY_AXIS)}),s("circle",{class:"bm-origin",r:4}));for(let part of this.parts)part.pin&&this.coupler.append(
part.pin);this.marks=new LoadMarks,this.group=s("g",{class:"bm-linkage"},this.arrow,this.links,this.coupler,this.blocks,this.pins,this.marks.group,links.length?
null:this.letter)}fits({led}){return kindsOf(led)===this.kinds}shape(data,linkage,view,places){this.view=view,this.led=linkage.led,this.hasBody=!!data.body,this.
hasBody?(put(this.outline,"d",bodyOutline(data,view)),this.outline.parentNode||this.group.prepend(this.outline)):this.outline.remove();let corners=[[0,0]];linkage.
led.forEach((dyad,side)=>{dyad.moving_pivot&&corners.push(inBody(dyad.moving_pivot,view));let more=this.parts[side].shape(dyad,view,places);more&&corners.push(more)});
let d=`M${hull(corners).map(corner=>corner.map(px).join(" ")).join("L")}Z`;for(let plate of linkage.drawn?[]:this.plates)put(plate,"d",d);for(let part of this.parts.
slice(linkage.led.length))part.shape(view);this.marks.shape(data,linkage,view),this.shapeArrow()}show(place,drive=null){let{view}=this,at=transform(view.X(place.
x),view.Y(place.y),place.a);this.marks.show(place,drive),put(this.coupler,"transform",at),this.hasBody&&put(this.outline,"transform",at);for(let part of this.parts)
part.show(place);let[x,y]=act(place,[LETTER2/view.scale,-LETTER2/view.scale]);put(this.letter,"transform",`translate(${px(view.X(x))} ${px(view.Y(y)+4)})`);let[
driver]=this.led;driver.kind==="PR"&&put(this.arrow,"transform",`${onRail(driver,place,view)} translate(0 ${-ARROW})`)}shapeArrow(){let{arrow:arrow2,view}=this,
[driver]=this.led;if(driver.kind==="PR"&&put(arrow2,"d","M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5"),!driver.fixed_pivot)return;let[x,y]=driver.fixed_pivot;put(arrow2,
"d",TURNING_ARROW),put(arrow2,"transform",`translate(${px(view.X(x))} ${px(view.Y(y))}) rotate(-90)`)}},kindsOf=led=>led.map(dyad=>dyad.kind).join(),inBody=([x,
y],view)=>[view.scale*x,-view.scale*y];function onRail(dyad,place,view){let[x,y]=act(place,dyad.moving_pivot),[nx,ny]=normalOf(dyad);return transform(view.X(x),
view.Y(y),Math.atan2(nx,-ny))}var block=(side,width,height)=>s("g",{class:`bm-block bm-side${side}`},s("rect",{x:-width/2,y:-height/2,width,height,rx:2}));function setPin(pin,[
x,y],dyad){put(pin,"cx",px(x)),put(pin,"cy",px(y)),put(pin,"data-dyad",dyad.id)}var inGround=([x,y],view)=>[view.X(x),view.Y(y)],Bar=class{constructor({links,pins},side){
this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"bm-core"})],this.bar=s("g",{class:`bm-link bm-side${side}`},this.strokes),this.ground=s("circle",{class:"\
bm-pin bm-fixed-pin",r:4.5}),this.pin=s("circle",{class:"bm-pin",r:4.5}),links.append(this.bar),pins.append(this.ground)}shape(dyad,view){this.dyad=dyad,this.view=
view;for(let stroke of this.strokes)put(stroke,"d",`M0 0H${px(view.scale*dyad.radius)}`);setPin(this.ground,inGround(dyad.fixed_pivot,view),dyad),setPin(this.pin,
inBody(dyad.moving_pivot,view),dyad)}show(place){let{dyad,view}=this,[cx,cy]=dyad.fixed_pivot,[x,y]=act(place,dyad.moving_pivot);put(this.bar,"transform",transform(
view.X(cx),view.Y(cy),Math.atan2(y-cy,x-cx)))}},BlockOnRail=class{constructor({blocks},side){this.block=block(side,...BLOCK),this.pin=s("circle",{class:"bm-pin",
r:4.5}),blocks.append(this.block)}shape(dyad,view){this.dyad=dyad,this.view=view,put(this.block,"data-dyad",dyad.id),setPin(this.pin,inBody(dyad.moving_pivot,view),
dyad)}show(place){put(this.block,"transform",onRail(this.dyad,place,this.view))}},Slot=class{constructor({blocks,pins,coupler},side){this.strokes=["rim","plate",
"edge"].map(name=>s("path",{class:`bm-slot-${name}`})),this.strokes.push(s("path",{class:"bm-slot"})),this.block=block(side,...BLOCK_IN_SLOT),this.ground=s("cir\
cle",{class:"bm-pin bm-fixed-pin",r:4}),coupler.append(...this.strokes),blocks.append(this.block),pins.append(this.ground)}shape(dyad,view,places){this.dyad=dyad,
this.view=view;let[low,high]=places.length?travelOf(dyad,places):[0,0],end=(BLOCK_IN_SLOT[0]/2+SPARE2)/view.scale,seen2=along2=>inBody(pointOnLine(dyad,along2),
view),d=`M${[seen2(low-end),seen2(high+end)].map(each=>each.map(px).join(" ")).join("L")}`;for(let stroke of this.strokes)put(stroke,"d",d);for(let part of[this.
strokes[3],this.block])put(part,"data-dyad",dyad.id);return setPin(this.ground,inGround(dyad.fixed_pivot,view),dyad),seen2((low+high)/2)}show(place){let{dyad,view}=this,
[nx,ny]=normalOf(dyad),[cx,cy]=dyad.fixed_pivot;put(this.block,"transform",transform(view.X(cx),view.Y(cy),place.a+Math.atan2(nx,-ny)))}},JointedLink=class{constructor({
links},{joints,kind}){this.joints=[...joints],this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"bm-core"})],links.append(s("g",{class:`bm-link bm-${kind}${joints.
length>2?" bm-ternary":""}`,"data-link":joints.replace("M","")},this.strokes))}shape(view){this.view=view}show(place){let d=`M${this.joints.map(joint=>inGround(
place.joints[joint]??[place.x,place.y],this.view).map(px).join(" ")).join("L")}${this.joints.length>2?"Z":""}`;for(let stroke of this.strokes)put(stroke,"d",d)}},
Joints=class{constructor({pins},ground,names){this.pins=[...Object.keys(ground),...Object.keys(names)].map(joint=>{let pin=s("circle",{class:`bm-pin${joint in ground?
" bm-fixed-pin":""}`,r:4.5,"data-joint":joint});return{joint,pin,link:[...names[joint]??""],name:joint in ground?null:s("text",{class:"bm-name","text-anchor":"m\
iddle"},joint)}}),pins.append(...this.pins.map(({pin})=>pin),...this.pins.flatMap(({name})=>name??[]))}shape(view){this.view=view}show({joints}){for(let{joint,pin,
link,name}of this.pins){let[x,y]=inGround(joints[joint],this.view);if(put(pin,"cx",px(x)),put(pin,"cy",px(y)),!name)continue;let[u,v]=outwards(link.map(each=>inGround(
joints[each],this.view)),[x,y]);put(name,"x",px(x+NAME*u)),put(name,"y",px(y+NAME*v+4))}}};function outwards(corners,[x,y]){let middle2=[0,1].map(k=>corners.reduce(
(sum,corner)=>sum+corner[k],0)/corners.length),u=x-middle2[0],v=y-middle2[1],size2=Math.hypot(u,v);return size2>1?[u/size2,v/size2]:[0,-1]}var Nothing=class{shape(){}show(){}},
PARTS={RR:Bar,PR:BlockOnRail,RP:Slot,PP:Nothing,crank:Nothing};var LONGEST=4e3;function railOf(dyad,places,view){let[nx,ny]=normalOf(dyad),[low,high]=travelOf(dyad,places),half=view.scale*(high-low)/2+BLOCK[0],edge=BLOCK[1]/
2+1,[x,y]=(at=>[view.X(at[0]),view.Y(at[1])])(pointOnLine(dyad,(low+high)/2)),bodySide=places.reduce((sum,place)=>sum+nx*place.x+ny*place.y-dyad.line.offset,0),
turned=Math.atan2(nx,-ny)+(bodySide>0?Math.PI:0),drawn=Math.min(half,LONGEST),hatch="";for(let k=-drawn+4;k<drawn-2;k+=8)hatch+=`M${px(k+4)} ${edge}l-6 7`;return{
x,y,half,drawn,turned,paths:[`M${px(-half)} ${edge}H${px(half)}${hatch}`,`M${px(-half)} ${-edge}H${px(half)}`]}}var FACTORS=[0,1,10,100,1e3,1e4,1e5];function factorFor(data,linkage){let worst=Math.max(0,...linkage.pose_errors.map(row=>row.position??0));if(!(worst>1e-9*data.
scene))return 0;let fits=FACTORS.filter(factor=>factor>=1&&factor*worst<.3*data.scene);return fits.length?fits[fits.length-1]:1}var scaleOfErrors=({width},factor)=>s("text",{class:"bm-error-scale",x:width-8,y:16,"text-anchor":"end"},factor===1?"errors to scale":`errors × ${factor.toLocaleString(
"en").replaceAll(","," ")}`);var hundredths=value=>Math.round(Math.min(Math.max(value,-1e6),1e6)*100)/100;function smoothPath(X,Y,closed2){let last=X.length-1;if(last<1)return"";let ahead=(values,k)=>k<
last?values[k+1]:closed2?values[1]:2*values[last]-values[last-1],behind=(values,k)=>k>0?values[k-1]:closed2?values[last-1]:2*values[0]-values[1],d=`M${hundredths(
X[0])} ${hundredths(Y[0])}`,[u,v]=[(ahead(X,0)-behind(X,0))/6,(ahead(Y,0)-behind(Y,0))/6];for(let k=0;k<last;k+=1){let p=(ahead(X,k+1)-X[k])/6,q=(ahead(Y,k+1)-Y[k])/
6;d+=`C${hundredths(X[k]+u)} ${hundredths(Y[k]+v)} ${hundredths(X[k+1]-p)} ${hundredths(Y[k+1]-q)} ${hundredths(X[k+1])} ${hundredths(Y[k+1])}`,[u,v]=[p,q]}return d}var MOST_ACHIEVED=240,OFF2=27,FOOT=11,LEAST_ARROW2=1.5,LiveLinkage=class{constructor(answers,playing,scene){this.answers=answers,this.playing=playing,this.scene=
scene,this.factor=0,this.beyond=s("path",{class:"bm-curve bm-beyond"}),this.others=s("path",{class:"bm-curve bm-other"}),this.here=s("path",{class:"bm-curve bm-\
here"}),this.pivotPaths=[0,1].map(side=>s("path",{class:`bm-pivot-path bm-side${side}`})),this.paths=s("g",{class:"bs-paths","aria-hidden":"true"},this.others,this.
beyond,...this.pivotPaths,this.here),this.feet=[0,1].map(side=>{let at=foot();return at.classList.add(`bm-side${side}`),at}),this.rails=[0,1].map(side=>s("g",{class:`\
bm-rail bm-side${side}`},s("path",{class:"bm-ground"}),s("path",{class:"bm-ground bm-thin"}))),this.achieved=s("g",{class:"bs-achieved"}),this.arrows=s("path",{}),
this.names=[0,1].map(side=>s("text",{class:`bm-name bm-side${side}`,"text-anchor":"middle"})),this.mechanism=null,this.holder=s("g",{class:"bs-mechanism"},...this.
rails,...this.feet,this.achieved,s("g",{class:"bm-errors"},this.arrows)),this.labels=s("g",{class:"bs-dyad-names"},this.names),this.edges=s("g",{class:"bs-edges"}),
scene.layer("paths").append(this.paths),scene.layer("mechanism").append(this.holder),scene.layer("labels").append(this.labels,this.edges),scene.hold?.(()=>this.
points()),scene.on("closer",()=>this.closer()),answers.on("shown",()=>scene.isFitted&&scene.fit(scene.isWhole)),playing.on("shape",()=>this.shape()),playing.on(
"place",({place,drive})=>this.mechanism?.show(place,drive)),scene.on("view",()=>this.redraw()),scene.names?.avoid(()=>this.obstacles()),this.redraw()}points(close=!1){
let{linkage}=this.playing,{data}=this.answers;return nearPoints(data,linkage,linkage?placesAtPoses(data,linkage):[],{close})}closer(){let{selection,document:{poses}}=this.
answers.store,k=selection?.kind==="pose"?selection.index:null,near2=k===null?[]:poses.slice(Math.max(0,k-1),k+2).map(pose=>[pose.x??0,pose.y??0]);this.scene.closeUp(
near2.length>1?near2:this.points(!0))}obstacles(){let{playing:{linkage},scene:{view}}=this;return(linkage&&!linkage.gone?linkage.led.filter(dyad=>dyad.fixed_pivot):
[]).map(({fixed_pivot:[x,y]})=>[view.X(x),view.Y(y)+FOOT,34,36])}enlarge(){let{linkage}=this.playing,{data}=this.answers,fits=linkage?.pose_errors.length&&!(linkage.
followed&&linkage.worst<UNSEEN*data.scene)?factorFor(data,linkage):0;this.factor=this.answers.isOld&&this.factor&&fits?Math.min(this.factor,fits):fits}redraw(){
this.shape(),this.playing.here&&this.playing.path&&this.mechanism?.show(this.playing.here.place,this.playing.here.drive)}shape(){let{playing,answers,scene}=this,
{linkage,path}=playing,{view}=scene,there=!!linkage&&!linkage.gone;for(let part of[this.paths,this.holder,this.labels,this.edges])put(part,"visibility",there?"v\
isible":"hidden");if(!there)return;let places=path?framesOf(path):[];if(this.enlarge(),this.curves(linkage,path,places,view),this.ground(linkage,places,view),this.
outside(linkage,view),this.atPoses(linkage,view),!path){this.mechanism?.group.remove(),this.mechanism=null;return}this.mechanism?.fits(linkage)||(this.mechanism?.
group.remove(),this.mechanism=new Mechanism(linkage),this.holder.append(this.mechanism.group)),this.mechanism.shape(answers.data,linkage,view,places)}curves(linkage,path,places,view){
let set=(element,list2,closed2)=>put(element,"d",smoothPath(list2.map(([x])=>view.X(x)),list2.map(([,y])=>view.Y(y)),closed2)),others=linkage.ways.filter(way=>way!==
path);if(put(this.others,"d",others.map(way=>pathOf2(way,view)).join("")),put(this.beyond,"d",path?pathOf2(path,view):""),this.pivotPaths.forEach((element,side)=>{
let dyad=linkage.led[side];!path||!dyad.moving_pivot||dyad.kind==="PR"?put(element,"d",""):set(element,places.map(place=>act(place,dyad.moving_pivot)),path.round)}),
!path){put(this.here,"d","");return}let{low,high}=this.playing.player.stretch,{length}=this.answers.data.chart,list=[],end=u=>(place=>[place.x,place.y])(placeAt(
linkage,path,u,length));list.push(end(low));for(let k=Math.floor(low)+1;k<high;k+=1)list.push([path.x[k],path.y[k]]);list.push(end(high)),set(this.here,list,path.
round&&high-low>path.x.length-1-1e-6)}ground(linkage,places,view){let{scene}=this;linkage.led.forEach((dyad,side)=>{let[rail,at,name]=[this.rails[side],this.feet[side],
this.names[side]],slides=dyad.kind==="PR"&&places.length>0;put(rail,"display",slides?"inline":"none"),put(at,"display",dyad.fixed_pivot?"inline":"none"),put(name,
"display",slides||dyad.fixed_pivot?"inline":"none"),say(name,dyad.id);let x,y;if(slides){let drawn=railOf(dyad,places,view);({x,y}=drawn),put(rail,"transform",transform(
x,y,drawn.turned)),drawn.paths.forEach((d,k)=>put(rail.children[k],"d",d)),put(rail,"data-dyad",dyad.id)}else if(dyad.fixed_pivot)[x,y]=[view.X(dyad.fixed_pivot[0]),
view.Y(dyad.fixed_pivot[1])],put(at,"transform",`translate(${px(x)} ${px(y)})`);else return;scene.names.put(name,x,y+FOOT,dyad.id,around(dyad.id,-Math.PI/2,OFF2))})}outside(linkage,view){
let marks=linkage.led.flatMap((dyad,side)=>{let edge=dyad.fixed_pivot&&edgeTowards(view,dyad.fixed_pivot),end=edge&&edge.x>view.width/2;return edge?[s("g",{class:`\
bm-to-far bm-side${side}`,"data-dyad":dyad.id,onclick:()=>this.scene.reveal(dyad.fixed_pivot)},s("path",{class:`bm-far-mark bm-side${side}`,d:"M-9 -6L3 0L-9 6",
transform:transform(edge.x,edge.y,edge.angle)}),s("text",{class:`bm-name bm-side${side}`,x:px(edge.x+(end?-12:12)),y:px(clamp(edge.y+4,14,view.height-24)),"text\
-anchor":end?"end":"start"},`${dyad.id} is outside`))]:[]});this.edges.replaceChildren(...marks,...this.factor?[scaleOfErrors(view,this.factor)]:[])}atPoses(linkage,view){
let{achieved,answers:{data}}=this,rows=linkage.pose_errors,count=Math.min(rows.length,MOST_ACHIEVED),small=count>24?.6:1;for(;achieved.children.length>count;)achieved.
lastChild.remove();for(;achieved.children.length<count;)achieved.append(s("g",{class:"bm-achieved"},s("path",{}),s("circle",{})));let arrows="";for(let k=0;k<count;k+=
1){let row=rows[k],group=achieved.children[k];if(group.dataset.size!==String(small)&&(group.dataset.size=small,put(group.children[0],"d",axes(.72*AXIS*small)),put(
group.children[1],"r",2.2*small)),row.x===null){put(group,"display","none");continue}put(group,"display","inline"),put(group.children[0],"display",data.poses[k]?.
angle_deg===null?"none":"inline"),put(group,"transform",transform(view.X(row.x),view.Y(row.y),radians(row.angle_deg))),group.classList.toggle("bm-elsewhere",row.
at!==this.playing.path),this.factor&&data.poses[k]&&(arrows+=arrow(view,data.poses[k],row,this.factor))}put(this.arrows,"d",arrows)}},framesOf=way=>Array.from(way.
x,(x,k)=>({x,y:way.y[k],a:way.angle[k]})),pathOf2=(way,view)=>smoothPath(Array.from(way.x,view.X),Array.from(way.y,view.Y),way.round);function arrow(view,pose,row,factor){
let x=view.X(pose.x),y=view.Y(pose.y),by=factor*view.scale,dx=by*(row.x-pose.x),dy=-by*(row.y-pose.y),size2=Math.hypot(dx,dy);if(!(size2>=LEAST_ARROW2))return"";
let head=Math.min(7,.5*size2),ux=dx/size2,uy=dy/size2,tip=`${px(x+dx)} ${px(y+dy)}`,barb=sign=>`L${px(x+dx-head*(ux-sign*.5*uy))} ${px(y+dy-head*(uy+sign*.5*ux))}`;
return`M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}`}function wayStory(way,poses){let noun=nounOf({poses}),names=poses.map(pose=>pose.label),here=way.poses.length===names.length?`all ${noun}s`:way.poses.length?`${noun}${way.
poses.length>1?"s":""} ${runs(way.poses,names)}`:`no ${noun}`,dead=way.dead.filter(Boolean).length,ends=way.round?"turns round":dead===2?"between two dead point\
s":dead?"up to a dead point":"open";return`${here}; ${ends}`}var Assemblies=class{constructor(data,take){this.data=data,this.take=take,this.name=`bm-way-${Math.random().toString(36).slice(2)}`,this.element=h("fieldset",{class:"\
bm-ways"})}build(linkage,index){let one=(way,k)=>h("label",{},h("input",{type:"radio",name:this.name,value:k,checked:k===index,onchange:()=>this.take(k)}),h("sp\
an",{},h("b",{},wayName(way,linkage).replace("assembly ","")),` ${wayStory(way,this.data.poses)}`));this.element.replaceChildren(h("legend",{},"Assembly"),...linkage.
ways.map(one)),give(this.element,"hidden",!linkage.ways.length||!!this.data.whole)}};var TURN_SECONDS=7,TURN=1e-6,NAME_ROWS=5,NUMBER_ROWS=2,MANY_POSES=100,ROW=13,LONGEST_TICK=18,NO_ERROR=1e-7,STEPS=360,SPEEDS=[.25,.5,1,2,4],LOOPS=[["back","there\
 and back"],["again","again and again"],["once","once"]],Player=class{parts;steps;tick;wholeLabel;speeds;loops;real;realLabel;constructor(data,show,rebuild){this.
data=data,this.draw={show,rebuild},this.linkage=null,this.way=0,this.u=0,this.heading=1,this.speed=1,this.loop="back",this.isReal=!1,this.whole=!1,this.stretch=
{low:0,high:1,sense:1},this.playing=!1,this.remaining=null,this.element=this.controls()}get path(){return this.linkage?.ways[this.way]}get stop(){return nounOf(
this.data)}controls(){let button2=(name,text,label,onclick)=>h("button",{type:"button",class:`bm-button ${name}`,"aria-label":label,title:label,onclick},text);this.
button=button2("bm-play","","Play",()=>this.play(!this.playing)),this.slider=h("input",{type:"range",class:"bm-slider",min:0,step:"any","aria-label":"Driver",oninput:()=>this.
go(this.turned(Number(this.slider.value)))}),this.box=h("input",{type:"checkbox",onchange:()=>this.playWhole(this.box.checked)}),this.boxName=h("span",{},"Whole\
 branch"),this.stops=s("svg",{class:"bm-stops","aria-hidden":"true"}),this.parts=["","","",""].map(text=>h("span",{},text)),this.readout=h("output",{class:"bm-n\
ow"},this.parts.flatMap((part,k)=>k?[" ",part]:[part])),this.slider.addEventListener("keydown",event=>{let step={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,ArrowUp:1}[event.
key];step&&(event.preventDefault(),this.step(event.shiftKey?10*step:step))});let choice=(label,entries,take)=>h("select",{class:"bm-pick","aria-label":label,title:label,
onchange:event=>take(event.target.value)},entries.map(([value,text])=>h("option",{value},text)));return this.steps=[button2("bm-back","","",()=>this.toPose(-1)),
button2("bm-next","","",()=>this.toPose(1))],this.speeds=choice("Speed",SPEEDS.map(each=>[each,`${each} ×`]),value=>this.speed=Number(value)),this.speeds.value=
"1",this.loops=choice("What comes after the last pose",LOOPS,value=>this.takeLoop(value)),this.real=h("input",{type:"checkbox",onchange:()=>this.isReal=this.real.
checked}),this.realLabel=h("label",{class:"bm-real",hidden:!0,title:"Move as the drive of the task moves it"},this.real,h("span",{},"As driven")),this.wholeLabel=
h("label",{class:"bm-whole"},this.box,this.boxName),this.nameStops(),h("div",{class:"bm-controls"},h("div",{class:"bm-track"},this.slider,this.stops),h("div",{class:"\
bm-row"},this.button,this.steps[0],button2("bm-small-step","‹","A small step back",()=>this.step(-1)),button2("bm-small-step","›","A small step on",()=>this.
step(1)),this.steps[1],this.speeds,this.loops,this.wholeLabel,this.realLabel),this.readout)}nameStops(){let{stop}=this,title=stop[0].toUpperCase()+stop.slice(1);
[[`◀ ${title}`,`Previous ${stop}`],[`${title} ▶`,`Next ${stop}`]].forEach(([text,label],k)=>{say(this.steps[k],text),put(this.steps[k],"aria-label",label),give(
this.steps[k],"title",label)}),give(this.wholeLabel,"title",`Play all that the driver reaches, not only from the first ${stop} to the last`)}load(linkage){this.
linkage=linkage;let counts=linkage.ways.map(way=>way.poses.length);this.take(Math.max(0,counts.indexOf(Math.max(...counts))))}take(index){this.way=index,this.u=
this.firstStop(),this.draw.rebuild()}get stopsOnWay(){return this.linkage.pose_errors.map((row,k)=>({...row,k})).filter(row=>row.way===this.way)}firstStop(){return this.
stopsOnWay[0]?.frame??0}rebuild(){let{path,slider}=this;path||this.play(!1),this.nameStops();for(let each of[slider,this.button])give(each,"disabled",!path);this.
linkage&&(this.stretch=stretchOf(this.linkage,this.way,this.whole)),give(this.box,"disabled",!this.stretch.isApart),give(this.realLabel,"hidden",!this.timed),say(
this.boxName,path?.round?"Whole turn":"Whole branch"),this.heading=1,this.u=clamp(this.u,this.stretch.low,this.stretch.high)}playWhole(on){this.whole=on,this.draw.
rebuild()}drawStops(){let{stops,path}=this,{low,high}=this.stretch;if(stops.replaceChildren(),!path)return;let width=Math.max(60,this.slider.clientWidth),inset=9,
X=u=>inset+(this.turned(u)-low)/(high-low)*(width-2*inset),rows=this.stopsOnWay.filter(row=>this.data.poses[row.k]).sort((a,b)=>X(a.frame)-X(b.frame)).map(row=>({
...row,x:X(row.frame),pose:this.data.poses[row.k]})),named=laidOut(rows.map(({x,pose})=>({x,text:shortened(poseName(pose),LONGEST_TICK)})),width,NAME_ROWS),texts=named.
every(({at})=>at>=0)?named:laidOut(rows.map(({x,pose})=>({x,text:pose.label})),width,rows.length>MANY_POSES?1:NUMBER_ROWS),deepest=Math.max(0,...texts.map(({at})=>at)),
one=(k,pose,...parts)=>s("g",{"data-pose":k+1},s("title",{},calledOf(pose)),...parts);rows.forEach(({k,x,pose},i)=>stops.append(one(k,pose,s("path",{d:`M${px(x)}\
 0V${4+ROW*Math.max(0,texts[i].at)}`})))),rows.forEach(({k,pose},i)=>{let{at,middle:middle2,text}=texts[i];at>=0&&stops.append(one(k,pose,s("text",{x:px(middle2),
y:14+ROW*at,"text-anchor":"middle"},text)))}),put(stops,"viewBox",`0 0 ${width} ${16+ROW*deepest}`),put(stops,"height",16+ROW*deepest)}play(on){if(on&&!this.path||
(this.remaining=null,on===this.playing&&this.isDressed)||(this.isDressed=!0,this.playing=on,put(this.readout,"aria-live",on?"off":"polite"),this.button.replaceChildren(
icon(on),on?"Pause":"Play"),put(this.button,"aria-label",on?"Pause":"Play"),this.button.title=on?"Pause (space)":"Play (space)",cancelAnimationFrame(this.tick),
!on))return;let before=null,run=now=>{this.playing&&(before!==null&&this.advance(Math.min(.1,(now-before)/1e3)),before=now,this.playing&&(this.tick=requestAnimationFrame(
run)))};this.tick=requestAnimationFrame(run)}playOnce(){if(!this.path)return;let{low,high}=this.stretch;this.u=this.turned(low),this.heading=1,this.play(!0),this.
remaining=(this.goesRound?1:2)*(high-low)}get goesRound(){return this.path.round&&this.stretch.high-this.stretch.low>this.path.x.length-1-TURN}turned(u){let{low,
high,sense}=this.stretch;return sense<0?low+high-u:u}get timed(){let loads=this.linkage?.followed?null:this.linkage?.loads;return loads?.way===this.way&&!this.whole?
loads.timed:null}takeLoop(loop){this.loop=loop,this.heading=1}advance(seconds){let{low,high}=this.stretch;if(this.isReal&&this.timed)return this.drive(seconds);
let step=this.speed*seconds*(high-low)/(this.goesRound?TURN_SECONDS:TURN_SECONDS/2);if(this.remaining!==null&&(this.remaining-=step,this.remaining<=0)){this.play(
!1),this.u=this.firstStop(),this.show();return}let at=this.turned(this.u)+this.heading*step,isOver=at>=high;isOver&&this.loop==="once"?(this.play(!1),this.u=this.
turned(high)):this.goesRound?this.u=this.turned(around2(at,high)):isOver&&this.loop==="again"?this.u=this.turned(low):((isOver||at<=low)&&(this.heading=isOver?-1:
1),this.u=this.turned(clamp(at,low,high))),this.show()}drive(seconds){let{timed}=this,{y}=timed.time,last=Math.max(y[0],y[y.length-1]),here=valueAt(timed.time,linear(
this.path.drive,this.u))??0,time=here+this.speed*seconds;if(time>=last&&here<last)time=last;else{if(time>=last&&this.loop==="once")return this.play(!1);time>=last&&
(time=0)}this.u=frameAt(this.path.drive,driveAtTime(timed,time)??linear(this.path.drive,this.u)??0),this.show()}step(steps){if(!this.path)return;let{low,high}=this.
stretch,at=this.turned(this.u)+steps*Math.max(.001,(high-low)/STEPS);this.go(this.turned(this.goesRound?around2(at,high):at))}go(u){this.path&&(this.play(!1),this.
u=clamp(u,this.stretch.low,this.stretch.high),this.show())}toPose(sense){let all=this.linkage.pose_errors.map((row,k)=>({...row,k})).filter(row=>row.way!==null);
if(!all.length)return;let here=this.atPose??(sense>0?-1:this.data.poses.length),next=sense>0?all.find(row=>row.k>here)??all[0]:[...all].reverse().find(row=>row.
k<here)??all[all.length-1];this.play(!1),next.way!==this.way&&(this.way=next.way,this.u=next.frame,this.draw.rebuild()),this.go(next.frame),this.atPose=next.k}placeAt(u){
return placeAt(this.linkage,this.path,u,this.data.chart.length)}nearest(place){let near2=0,least2=1/0;return this.data.poses.forEach((pose,k)=>{let turn=pose.angle_deg===
null?0:place.a-radians(pose.angle_deg),away=Math.hypot(place.x-pose.x,place.y-pose.y,this.data.chart.length*(turn-2*Math.PI*Math.round(turn/(2*Math.PI))));away<
least2&&([near2,least2]=[k,away])}),near2}show(told=!0){let{path}=this;if(!path){for(let part of this.parts)part.textContent="";return}let place=this.placeAt(this.
u),drive=linear(path.drive,this.u),transmission=linear(path.transmission,this.u),near2=this.atPose=this.nearest(place);told&&(give(this.slider,"min",this.stretch.
low),give(this.slider,"max",this.stretch.high),give(this.slider,"value",this.turned(this.u)),this.tell(place,drive,transmission,near2)),this.draw.show(place,drive,
transmission,near2)}driverText(drive){let{data,linkage}=this;return linkage.led[0].kind==="PR"?`${fixed(drive,decimalsOf(data))}${data.unit?` ${data.unit}`:""}`:
`${linkage.crank??""}${fixed(drive,1)}°`}tell(place,drive,transmission,near2){let{data,linkage}=this,unit=data.unit?` ${data.unit}`:"",digits=decimalsOf(data),
driver=this.driverText(drive),pose=data.poses[near2],row=linkage.pose_errors[near2],at=row?.at===this.path&&Math.abs(row.frame-this.u)<1e-6,away=()=>`${figure(Math.
hypot(place.x-pose.x,place.y-pose.y))}${unit} from ${calledOf(pose)}`,missed2=()=>`at ${calledOf(pose)}, ${row.said.position==="exact"?"":"off by "}${missOf(row.
said.position,row.said.turned,unit)}`,said=pose?pose.called?`${at?"at":"near"} ${pose.called}`:at?missed2():away():"between the poses",time=this.isReal&&this.timed&&
drive!==null?valueAt(this.timed.time,drive):null,texts=[...this.path.told?.map(each=>this.toldOf(each))??[`driver ${driver}${time===null?"":` at ${fixed(time,2)}\
 s`}`,`body (${fixed(place.x,digits)}, ${fixed(place.y,digits)})${unit}, ${fixed(((degrees(place.a)+180)%360+360)%360-180,2)}°`],`transmission ${transmission===
null?"–":`${fixed(transmission,1)}°`}`,said];texts.forEach((text,k)=>{let whole=k+1<texts.length?`${text} ·`:text;this.parts[k].textContent!==whole&&(this.parts[k].
textContent=whole)}),put(this.slider,"aria-valuetext",`${texts[0]}, ${texts[3]}`)}toldOf({name,digits,values,panel}){let error=panel===void 0?null:valueAt(this.
linkage.panels[panel],smooth(this.path.drive,this.u)),off=error===null?"":`, off by ${Math.abs(error)<NO_ERROR?"0":figure(error)}°`;return`${name} ${fixed(smooth(
values,this.u),digits)}°${off}`}};function laidOut(texts,width,count){let ends=Array(count).fill(-99);return texts.map(({x,text})=>{let size2=6.4*text.length,left=clamp(
x-size2/2,0,Math.max(0,width-size2)),at=ends.findIndex(end=>left>end+4);return at>=0&&(ends[at]=left+size2),{text,at,middle:left+size2/2}})}var around2=(u,turn)=>(u%
turn+turn)%turn;function icon(pause){return s("svg",{width:12,height:12,viewBox:"0 0 12 12","aria-hidden":"true"},s("path",{d:pause?"M1 0h3.5v12H1zM7.5 0H11v12H\
7.5z":"M1 0l11 6l-11 6z"}))}function driveOf(dyad,place){if(dyad.kind==="PR")return alongLine(dyad,place);if(dyad.kind==="RP")return place.a+radians(dyad.line.normal_deg);let[x,y]=act(place,
dyad.moving_pivot);return Math.atan2(y-dyad.fixed_pivot[1],x-dyad.fixed_pivot[0])}function transmissionOf(driver,follower,place){if(driver.kind==="PP"||follower.
kind==="PP")return null;let slot=dyad=>{let[nx,ny]=normalOf(dyad),c=Math.cos(place.a),d=Math.sin(place.a);return[c*nx-d*ny,d*nx+c*ny]};if(driver.kind==="RP"&&follower.
kind==="RP")return 90;if(follower.kind==="RP"){let pin=act(place,driver.moving_pivot),[x,y]=follower.fixed_pivot;return between(slot(follower),[x-pin[0],y-pin[1]])}
let end=act(place,follower.moving_pivot),lever=follower.kind==="PR"?normalOf(follower):[end[0]-follower.fixed_pivot[0],end[1]-follower.fixed_pivot[1]];if(driver.
kind==="RP")return between(slot(driver),lever);let start=act(place,driver.moving_pivot);return between([end[0]-start[0],end[1]-start[1]],lever)}var between=(a,b)=>Math.
atan2(Math.abs(a[0]*b[1]-a[1]*b[0]),Math.abs(a[0]*b[0]+a[1]*b[1]))*180/Math.PI;var APART=3,GOLDEN=.381966011250105,HALVINGS=24;function drivenByOther(linkage,length){let led=[linkage.led[1],linkage.led[0]];if(led[0].kind==="PP"||!linkage.ways.
length)return{...linkage,led,loads:null,ways:[],pose_errors:linkage.pose_errors.map(row=>({...row,way:null,frame:null,at:null}))};let ways=[],places=Array(linkage.
pose_errors.length).fill(null);for(let chain of chainsOf(linkage.ways))for(let piece of piecesOf(linkage,led[0],chain,length)){let way=wayOf(linkage,led,piece,chain,
length),number=ways.push(way)-1;linkage.pose_errors.forEach((row,k)=>{let frame=places[k]||row.way===null?null:frameIn(piece,row,linkage.ways[row.way].x.length-
1);frame!==null&&(places[k]=[number,way.falls?piece.stations.length-1-frame:frame],way.poses.push(k+1))})}let named=new Map;for(let way of ways)way.branches=ways.
filter(each=>each.circuit===way.circuit).length,named.set(way.circuit,(named.get(way.circuit)??0)+1),way.branch=named.get(way.circuit);let pose_errors=linkage.pose_errors.
map((row,k)=>({...row,way:places[k]?.[0]??null,frame:places[k]?.[1]??null,at:places[k]?ways[places[k][0]]:null,transmission_deg:row.x===null?null:transmissionOf(
led[0],led[1],{x:row.x,y:row.y,a:row.angle_deg*Math.PI/180})}));return{...linkage,led,loads:null,ways,pose_errors}}function chainsOf(ways){let chains=[];for(let circuit of new Set(
ways.map(way=>way.circuit))){let own=ways.map((way,number)=>({way,number})).filter(({way})=>way.circuit===circuit),stations=({way,number},turned)=>{let all=Array.
from(way.x,(_,u)=>({way:number,u}));return turned?all.reverse():all},[one,other]=own,joined=(end,start)=>other&&one.way.dead[end]&&other.way.dead[start]&&near(one.
way,end,other.way,start);if(!other||!(joined(0,0)||joined(1,1))){for(let each of own)chains.push({circuit,closed:each.way.round,stations:stations(each,!1)});continue}
let closed2=joined(0,0)&&joined(1,1),high=joined(1,1),through=[...stations(one,!high),...stations(other,high).slice(1)];chains.push({circuit,closed:closed2,stations:through})}
return chains}function near(one,end,other,start){let at=(way,k)=>[way.x[k],way.y[k]],last=(way,k)=>k?way.x.length-1:0,[i,j]=[last(one,end),last(other,start)],inner=end?
i-1:1,step=Math.hypot(...at(one,i).map((v,k)=>v-at(one,inner)[k]));return Math.hypot(...at(one,i).map((v,k)=>v-at(other,j)[k]))<=APART*step+1e-9*Math.hypot(...at(
one,i))}function piecesOf(linkage,driver,{circuit,closed:closed2,stations},length){let placeOf=({way,u})=>placeAt(linkage,linkage.ways[way],u,length),slides=driver.
kind==="PR",before=null,driveAt=station=>{let drive=driveOf(driver,placeOf(station));return!slides&&before!==null&&(drive-=2*Math.PI*Math.round((drive-before)/(2*
Math.PI))),drive},drives=stations.map(station=>before=driveAt(station)),count=stations.length-1,sense=k=>Math.sign(drives[k+1]-drives[k]),cuts=[];for(let k=1;k<
count;k+=1)sense(k)*sense(k-1)<0&&cuts.push(k);if(closed2&&sense(0)*sense(count-1)<0&&cuts.push(0),!cuts.length)return[{circuit,round:closed2,dead:[!1,!1],stations}];
let dead=new Map(cuts.map(k=>[k,extreme(k)]));function extreme(k){let here=stations[k],up=drives[k]>drives[k===0?1:k-1]?1:-1;before=drives[k];let sides=[k>0?k-1:
count-1,k+1].map(at2=>{let there=stations[at2];return there.way===here.way&&Math.abs(there.u-here.u)<1.5?[here.way,here.u,there.u]:[there.way,there.u,there.u<1.5?
0:there.u+1]}),value=(way,u)=>up*driveAt({way,u}),best={station:here,value:value(here.way,here.u)};for(let[way,u,v]of sides){let[low,high]=[Math.min(u,v),Math.max(
u,v)];for(let step=0;step<HALVINGS;step+=1){let[a,b]=[low+GOLDEN*(high-low),high-GOLDEN*(high-low)];value(way,a)<value(way,b)?low=a:high=b}let station={way,u:(low+
high)/2},found=value(way,station.u);found>best.value&&(best={station,value:found})}return best.station}let part=(from,to)=>{let inner=[];for(let k=from+1;k<to;k+=
1)inner.push(stations[closed2?k%count:k]);let ends=[from,to].map(k=>dead.get(closed2?k%count:k)??stations[k]);return[ends[0],...inner.filter(each=>!ends.some(end=>end.
way===each.way&&Math.abs(end.u-each.u)<.001)),ends[1]]};if(cuts.sort((a,b)=>a-b),closed2){let at2=[...cuts,cuts[0]+count];return at2.slice(1).map((to,k)=>({circuit,
round:!1,dead:[!0,!0],stations:part(at2[k],to)}))}let at=[0,...cuts,count];return at.slice(1).map((to,k)=>({circuit,round:!1,dead:[k>0,to<count],stations:part(at[k],
to)}))}function wayOf(linkage,led,piece,chain,length){let slides=led[0].kind==="PR",places=piece.stations.map(({way,u})=>({...placeAt(linkage,linkage.ways[way],
u,length)})),drive=[];places.forEach((place,k)=>{let value=driveOf(led[0],place);!slides&&k&&(value-=2*Math.PI*Math.round((value-drive[k-1])/(2*Math.PI))),k&&(place.
a-=2*Math.PI*Math.round((place.a-places[k-1].a)/(2*Math.PI))),drive.push(value)});let falls=drive[drive.length-1]<drive[0];falls&&[drive,places].forEach(each=>each.
reverse());let turns=slides?0:2*Math.PI*Math.round((drive[0]+drive[drive.length-1])/(4*Math.PI));return{circuit:chain.circuit,round:piece.round,dead:falls?[...piece.
dead].reverse():piece.dead,poses:[],falls,drive:drive.map(value=>slides?value:degrees(value-turns)),x:places.map(({x})=>x),y:places.map(({y})=>y),angle:places.map(
({a})=>a),transmission:places.map(place=>transmissionOf(led[0],led[1],place))}}function frameIn({stations},{way,frame},last){for(let k=0;k+1<stations.length;k+=
1){let[a,b]=[stations[k],stations[k+1]];if(a.way!==way||b.way!==way){if(a.way===way&&Math.abs(a.u-frame)<1e-9)return k;if(b.way===way&&Math.abs(b.u-frame)<1e-9)
return k+1;continue}let[u,v]=Math.abs(b.u-a.u)>last/2?[a,b].map(each=>each.u+(each.u<last/2?last:0)):[a.u,b.u];for(let at of[frame,frame+last]){if(at>=Math.min(
u,v)-1e-9&&at<=Math.max(u,v)+1e-9)return u===v?k:k+(at-u)/(v-u);if(Math.max(u,v)<=last)break}}return null}var REDUCED_MOTION="(prefers-reduced-motion: reduce)",AT_POSE=1e-6,Playing=class extends Events{constructor(store,answers){super(),this.store=store,this.answers=
answers,this.isOther=!1,this.here=null,this.player=new Player(answers.data,(place,drive,transmission,near2)=>this.placed({place,drive,transmission,near:near2}),
()=>this.rebuild()),this.assemblies=new Assemblies(answers.data,index=>this.player.take(index)),this.drivers=h("fieldset",{class:"bm-ways bs-drivers",hidden:!0}),
this.note=h("p",{class:"bs-quiet bs-driver-note"}),this.element=h("div",{class:"bs-player"},this.player.element,h("div",{class:"bs-player-ways"},this.drivers,this.
assemblies.element),this.note),this.words=new Pace(()=>this.player.path&&this.player.show()),this.marks=new Pace(()=>this.player.drawStops()),answers.on("answer\
s shown placed",()=>this.load()),answers.on("moved",()=>this.follow()),store.on("selection",()=>this.goToSelected()),store.on("state",()=>this.hush()),new ResizeObserver(
()=>this.marks.ask()).observe(this.element),this.load()}get linkage(){return this.player.linkage}get path(){return this.player.path}load(){let base=this.answers.
shown??null;if(base===this.base&&base){this.follow(),this.tellDriver();return}if(this.base=base,this.isOther=!1,this.at=null,this.dress(),!base){this.player.linkage=
null,this.player.way=0,this.player.play(!1);for(let each of[this.assemblies.element,this.drivers])give(each,"hidden",!0);say(this.note,""),this.element.classList.
add("bs-empty"),this.emit("shape",!1);return}this.element.classList.remove("bs-empty"),this.player.load(this.driven()),this.goToSelected()}driven(){return this.
isOther?drivenByOther(this.base,this.answers.data.chart.length):this.base}driveBy(other){this.isOther=other,this.player.linkage=this.driven(),this.at=null,this.
takeBest(),this.rebuild(),this.tellDriver()}takeBest(){let counts=this.linkage.ways.map(way=>way.poses.length);this.player.way=Math.max(0,counts.indexOf(Math.max(
...counts))),this.player.u=this.player.firstStop()}follow(){let{base,player}=this;if(!base)return;player.linkage=this.driven();let row=this.at?.pose===void 0?null:
player.linkage.pose_errors[this.at.pose];row&&row.way!==null?(player.way=row.way,player.u=row.frame):player.path?this.at&&(player.u=this.frameOf(player.path,this.
at.drive)):player.linkage.ways.length&&this.takeBest(),player.rebuild(),this.emit("shape",!0),player.show(!1),this.words.ask(),this.marks.ask()}frameOf(way,drive){
if(drive===null||this.linkage.led[0].kind==="PR")return frameAt(way.drive,drive??way.drive[0]);let middle2=(way.drive[0]+way.drive[way.drive.length-1])/2;return frameAt(
way.drive,drive-360*Math.round((drive-middle2)/360))}rebuild(){let{player}=this;player.rebuild(),this.assemblies.build(this.linkage,player.way),this.buildDrivers(),
this.emit("shape",!1),this.marks.ask(),player.show()}placed(here){this.here=here;let{path,u}=this.player,pose=this.linkage.pose_errors.findIndex(row=>row.at===path&&
Math.abs(row.frame-u)<AT_POSE);this.at={drive:here.drive,pose:pose<0?void 0:pose},this.emit("place",here)}goToSelected(){let{selection}=this.store,{player}=this;
if(selection?.kind!=="pose"||player.playing)return;let row=this.linkage?.pose_errors[selection.index];if(!row||row.way===null)return;let other=row.way!==player.
way;player.way=row.way,player.u=row.frame,other?this.rebuild():player.go(row.frame)}buildDrivers(){let{base}=this;if(give(this.drivers,"hidden",!base||!base.ways.
length||base.led.some(dyad=>dyad.kind==="PP")),this.drivers.hidden)return;let key=`${base.id} ${base.led.map(dyad=>dyad.id)} ${this.isOther}`;if(key===this.driversKey)
return;this.driversKey=key;let one=(dyad,other)=>h("label",{},h("input",{type:"radio",name:"bs-driver",checked:other===this.isOther,"data-driver":dyad.id,onchange:()=>this.
driveBy(other)}),h("span",{},h("b",{},dyad.id),` ${{RR:"crank or rocker",PR:"slider on its rail",RP:"slot"}[dyad.kind]}`));this.drivers.replaceChildren(h("legen\
d",{},"Driver"),one(base.led[0],!1),one(base.led[1],!0)),this.tellDriver()}tellDriver(){let{base}=this;if(!base?.drives||base.followed){say(this.note,"");return}
let driver=this.isOther?base.led[1]:base.led[0],drive=base.dyads[0].id===driver.id?base.drives.first:base.drives.second,least2=drive.min_transmission_angle_deg.
range,said=drive.defects.length?drive.defects.map(each=>each.message).join("; "):`${drive.turns_fully?"turns fully":"reaches every pose"}${least2===null?"":`, t\
ransmission angle ${fixed(least2,1)}° or more between the poses`}`;say(this.note,`Driven by ${driver.id}: ${said}.`)}dress(){this.driversKey=null}hush(){let quiet=this.
store.state==="dragging"||this.player.playing;put(this.player.readout,"aria-live",quiet?"off":"polite")}};function playOnce(store,answers,{player}){if(matchMedia(
REDUCED_MOTION).matches)return;let first=!0;answers.on("answers",()=>{first&&player.path&&(first=!1,player.playOnce())}),store.on("document selection",()=>{first=
!1,player.remaining!==null&&player.play(!1)})}function about([x,y],{turn=0,scale=1,mirror=!1}){let[u,v]=linear2({turn,scale,mirror},[x,y]);return{turn,scale,mirror,x:x-u,y:y-v}}var quarters=({turn})=>Number.
isInteger(turn/90)?(turn/90%4+4)%4:NaN;function linear2(by,[x,y]){let q=quarters(by),a=radians(by.turn),[c,s2]=Number.isNaN(q)?[Math.cos(a),Math.sin(a)]:[[1,0],
[0,1],[-1,0],[0,-1]][q],v=by.mirror?-y:y;return[by.scale*(c*x-s2*v),by.scale*(s2*x+c*v)]}function moved(by,point){let[x,y]=linear2(by,point);return[tidy(x+by.x),
tidy(y+by.y)]}var direction=(by,angle)=>tidy(by.turn+(by.mirror?-angle:angle));var changed=(table,changes)=>table&&withKeys(table,Object.fromEntries(Object.entries(changes).filter(([key])=>table[key]!==void 0).map(([key,change])=>[key,change(
table[key])])));var swapped=(by,key)=>quarters(by)%2===1?{x:"y",y:"x"}[key]??key:key;function movedTolerance(by,stated){let size2=bound=>typeof bound=="number"?tidy(by.scale*bound):
bound,fixed2=stated.axes!=="body",bounds2=["x","y"].filter(key=>stated[key]!==void 0).map(key=>[fixed2?swapped(by,key):key,size2(stated[key])]);return{...withKeys(
stated,{x:void 0,y:void 0}),...Object.fromEntries(bounds2)}}function movedPose(by,pose){let[x,y]=moved(by,[pose.x??0,pose.y??0]),there={x,y,...pose.angle===void 0?
{}:{angle:direction(by,pose.angle)}};for(let key of["x","y"])pose[key]===void 0&&delete there[swapped(by,key)];return{...withKeys(pose,{x:void 0,y:void 0,angle:void 0}),
...there,...changed({free:pose.free,tolerance:pose.tolerance},{free:keys=>keys.map(key=>swapped(by,key)),tolerance:stated=>movedTolerance(by,stated)})}}function withPosesMoved(document2,indices,by){
let chosen=new Set(indices);return aslant({poses:document2.poses.filter((_,k)=>chosen.has(k)),tolerance:document2.tolerance},by)?null:withKeys(document2,{poses:document2.
poses.map((pose,k)=>chosen.has(k)?movedPose(by,pose):pose)})}function aslant({poses,tolerance},by){if(!Number.isNaN(quarters(by)))return"";let differs=stated=>stated&&
stated.axes!=="body"&&!!(stated.x||stated.y)&&!(stated.x==="free"&&stated.y==="free"),index=poses.findIndex(pose=>(pose.free??[]).filter(key=>key!=="angle").length===
1||differs(pose.tolerance)),which=index>=0?`pose ${index+1}`:differs(tolerance)?"the poses":"";return which&&`Only quarter turns are possible: ${which} may be m\
issed along the axes of the ground, and they have no others.`}var LONGEST_ARM=46,SHORTEST_ARM=27,FEW=24,MOST2=240,ROOM2=14,NAME2=14,LONGEST_NAME2=18,ARROWS2={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},
unwrapped=(angle,near2)=>angle+360*Math.round((near2-angle)/360),strideOf=({poses},scale)=>{let length=poses.slice(1).reduce((sum,{x,y},k)=>sum+(Math.hypot(x-poses[k].
x,y-poses[k].y)||0),0);return poses.length<=FEW?1:Math.ceil(poses.length/clamp(scale*length/ROOM2,FEW,MOST2))};function drawnPoses({document:document2,selection},scale){
let{poses}=document2,count=poses.length,all=[...poses.keys()];if(count<=FEW)return all;let stride=strideOf(document2,scale),chosen=selection?.kind==="pose"?selection.
indices??[selection.index]:[];return all.filter(k=>k%stride===0||k===count-1||chosen.includes(k))}var PoseHandles=class{constructor(store,scene){this.store=store,
this.scene=scene,this.element=scene.layer("poses"),this.names=scene.layer("labels"),this.kept=new Kept(this.element,k=>this.make(k),(group,k)=>this.show(group,k)),
this.labels=new Kept(this.names,()=>s("text",{class:"bs-pose-name"}),(text,k)=>this.showName(text,k)),store.on("document selection reference",()=>this.draw()),scene.
on("view",()=>this.draw()),scene.on("marquee",([x,y,u,v])=>store.selectPoses([...store.document.poses.keys()].filter(k=>{let at=standing(store.document,k);return at.
x>=x&&at.x<=u&&at.y>=y&&at.y<=v}))),scene.on("key",event=>store.selectedPoses.length>0&&this.key(event,store.selection.index,!1)),scene.hold(()=>store.document.
poses.map((_,k)=>standing(store.document,k)).map(({x,y})=>[x,y])),scene.on("click",()=>store.select(null)),scene.names.avoid(()=>this.obstacles()),this.draw()}get arm(){
let{document:document2}=this.store,{scale}=this.scene.view,places=drawnPoses(this.store,scale).map(k=>standing(document2,k)),away=places.slice(1).map(({x,y},k)=>scale*
Math.hypot(x-places[k].x,y-places[k].y)).sort((a,b)=>a-b);return away.length?clamp(1.2*away[away.length>>1],SHORTEST_ARM,LONGEST_ARM):LONGEST_ARM}draw(){this.length=
this.scene.dragged?this.length??this.arm:this.arm;let poses=drawnPoses(this.store,this.scene.view.scale).map(k=>[k,k]);this.kept.draw(poses),this.labels.draw(poses.
length>FEW&&isPath(this.store.document)?[]:poses)}make(k){let origin=s("g",{class:"bs-origin","data-pose":k+1,tabindex:0,role:"button"},s("circle",{class:"bs-ho\
ld",r:12}),s("circle",{class:"bs-dot",r:5.5})),turn=s("g",{class:"bs-turn","data-turn":k+1,tabindex:0,role:"slider","aria-valuemin":-360,"aria-valuemax":360},s(
"circle",{class:"bs-hold",r:12}),s("circle",{class:"bs-tip",r:5})),group=s("g",{class:"bs-pose"},s("path",{class:"bs-axes"}),origin,turn);this.dragOrigin(origin,
k),this.dragTurn(turn,k);for(let part of[origin,turn])part.addEventListener("focus",()=>this.touch(k));return origin.addEventListener("keydown",event=>this.key(
event,k,!1)),turn.addEventListener("keydown",event=>this.key(event,k,!0)),group}show(group,k){let{store,scene:{view}}=this,{x,y,angle}=standing(store.document,k),
pose=store.document.poses[k],selected=store.selectedPoses.includes(k),isReference=store.referenceIndex===k,unit=store.document.length_unit??"",name=poseName2(store.
document,k),point=isPoint2(pose);if(!isOther(group,[view,this.length,x,y,angle,!!pose.exact,pose.name,name,unit,selected,isReference,point]))return;let[arrow2,origin,
turn]=group.children;put(group,"transform",transform(view.X(x),view.Y(y),point?0:radians(angle)));for(let part of[arrow2,turn])put(part,"display",point?"none":"\
inline");group.classList.toggle("bs-point",point),put(arrow2,"d",axes(this.length-8)),put(turn,"transform",`translate(${px(this.length)} 0)`),group.classList.toggle(
"bs-selected",selected),group.classList.toggle("bs-reference",isReference),group.classList.toggle("bs-exact",!!pose.exact);let what=point?"Point":"Pose",called=pose.
name?`${what} ${k+1}, ${name}`:`${what} ${k+1}`;put(origin,"aria-label",`${called}: x ${x} ${unit}, y ${y} ${unit}, ${point?"angle free":`angle ${angle}°`}. Dr\
ag, or use the arrow keys; Delete removes it.`),put(origin,"aria-pressed",selected),put(turn,"aria-label",`Turn ${called}`),put(turn,"aria-valuenow",angle),put(
turn,"aria-valuetext",`${angle}°`)}obstacles(){let{store,scene:{view},length}=this,boxes=[];for(let k of drawnPoses(store,view.scale)){let{x,y,angle}=standing(
store.document,k),a=radians(angle),[c,d]=[Math.cos(a),Math.sin(a)],at=(along2,across,size2)=>boxes.push([view.X(x)+along2*c-across*d,view.Y(y)-along2*d-across*c,
size2,size2]);if(at(0,0,13),!isPoint2(store.document.poses[k])){at(length,0,12),at(LETTER2,-LETTER2,12);for(let share of[.35,.7])at(share*length,0,6);for(let share of[
.3,.6])at(0,share*(length-8),6)}}return boxes}showName(text,k){let{store,scene}=this,{view}=scene,{x,y,angle}=standing(store.document,k),isHere=store.isOnBody&&
k===store.referenceIndex,name=`${shortened(poseName2(store.document,k),LONGEST_NAME2)}${isHere?": drawn here":""}`;text.classList.toggle("bs-reference",k===store.
referenceIndex),isOther(text,[view,x,y,angle,name])&&(say(text,name),scene.names.put(text,view.X(x),view.Y(y),name,around(name,radians(angle+215),NAME2,scene.names.
areMany)))}set(k,changes,gesture){this.store.edit(document2=>setPose(document2,k,statedOf(document2.poses[k],changes)),{gesture})}touch(k){let{store,scene}=this;
scene.pressed?.shiftKey||(store.selectedPoses.includes(k)?store.selectPoses(store.selectedPoses,k):store.select({kind:"pose",index:k}))}click(event,k){return event.
shiftKey?this.store.selectAlso(k):(this.store.select({kind:"pose",index:k}),this.openField(k))}heldWith(k){let{store}=this;return store.selectedPoses.includes(k)||
store.select({kind:"pose",index:k}),store.selectedPoses}openField(k){let{store,scene}=this,isThere=()=>store.selectedPoses.includes(k),point=isPoint2(store.document.
poses[k]);scene.field.open({name:`pose ${k+1}`,kind:"pose",at:()=>isThere()&&Object.values(standing(store.document,k)).slice(0,2),values:()=>standing(store.document,
k),fields:[["x","x","length"],["y","y","length"],...point?[]:[["angle","angle °","angle"]]],set:changes=>this.set(k,changes,null)})}moveAll(before,indices,by,gesture){
let next=withPosesMoved(before,indices,by);next&&this.store.edit(document2=>({...document2,poses:next.poses}),{gesture})}dragOrigin(element,k){let{store,scene}=this,
gesture,off,before,reach,start,held;scene.drag(element,{start:from=>{let{x,y}=standing(store.document,k);gesture=Symbol("move a pose"),start=[x,y],off=[x-from.x,
y-from.y],before=store.document,reach=isPath(before)?strideOf(before,scene.view.scale):1,held=this.heldWith(k),this.openField(k)},move:(point,event)=>{let to=scene.
snap.point([point.x+off[0],point.y+off[1]],{event,from:start,skip:of=>held.some(each=>of.endsWith(`pose ${each}`))});held.length>1?this.moveAll(before,held,{turn:0,
scale:1,mirror:!1,x:to[0]-start[0],y:to[1]-start[1]},gesture):reach>1?this.bend(before,k,reach,[to[0]-start[0],to[1]-start[1]],gesture):this.set(k,{x:to[0],y:to[1]},
gesture)},cancel:()=>store.abandon(gesture),click:event=>this.click(event,k)})}bend({poses,path},k,reach,[dx,dy],gesture){let count=poses.length,moved2=poses.map(
(pose,j)=>{let away=path?.closed?Math.min(Math.abs(j-k),count-Math.abs(j-k)):Math.abs(j-k),share=1-away/reach;return share>0?{...pose,x:this.scene.rounded(pose.
x+share*dx),y:this.scene.rounded(pose.y+share*dy)}:pose});this.store.edit(document2=>({...document2,poses:moved2}),{gesture})}dragTurn(element,k){let{store,scene}=this,
gesture,off,before,held,angleTo=point=>{let{x,y}=standing(store.document,k);return degrees(Math.atan2(point.y-y,point.x-x))};scene.drag(element,{start:from=>{gesture=
Symbol("turn a pose"),before=store.document,held=this.heldWith(k),off=standing(before,k).angle-angleTo(from),this.openField(k)},move:(point,event)=>{let{x,y,angle:now}=standing(
store.document,k),angle=scene.snap.angle(unwrapped(angleTo(point)+off,now),[point.x,point.y],{event,skip:k});held.length>1?this.moveAll(before,held,about([x,y],
{turn:angle-standing(before,k).angle}),gesture):this.set(k,{angle},gesture)},cancel:()=>store.abandon(gesture),click:event=>this.click(event,k)})}key(event,k,turning){
let{store,scene}=this,arrow2=ARROWS2[event.key],held=store.selectedPoses.includes(k)?store.selectedPoses:[k];if(event.ctrlKey||event.metaKey)return!1;if(arrow2){
event.repeat||(this.keyed=Symbol("keys"));let{x,y,angle}=standing(store.document,k),by=stepOf(event,turning?1:scene.step);held.length>1&&turning?this.moveAll(store.
document,held,about([x,y],{turn:by*(arrow2[0]===0?arrow2[1]:-arrow2[0])}),this.keyed):held.length>1?this.moveAll(store.document,held,{turn:0,scale:1,mirror:!1,x:by*
arrow2[0],y:by*arrow2[1]},this.keyed):turning?this.set(k,{angle:stepped(angle,by*(arrow2[0]===0?arrow2[1]:-arrow2[0]))},this.keyed):this.set(k,{x:stepped(x,by*arrow2[0]),
y:stepped(y,by*arrow2[1])},this.keyed)}else if(event.key==="Delete"||event.key==="Backspace"){store.edit(document2=>removePoses(document2,held));let left=store.
document.poses.length,next=Math.min(held.length>1?held[0]:k,left-1);store.select(left?{kind:"pose",index:next}:null),this.focus(next)}else return!1;return event.
preventDefault(),!0}focus(k){this.element.querySelector(`[data-pose="${k+1}"]`)?.focus({preventScroll:!0})}};var PoseTool=class{constructor(store,scene){this.store=store,this.scene=scene,this.name="pose",this.gesture=null,this.hint="Click where the pose is to stand, an\
d click again to turn it. Escape ends."}click(point,event){let{store,scene}=this;if(this.gesture){this.turn(point,event),this.gesture=null;return}let[x,y]=scene.
snap.point([point.x,point.y],{event});this.gesture=Symbol("add a pose");let angle=store.document.poses.findLast(pose=>Number.isFinite(pose.angle))?.angle??0;store.
edit(document2=>addPose(document2,{x,y,angle}),{gesture:this.gesture}),store.select({kind:"pose",index:store.document.poses.length-1})}hover(point,event){this.gesture&&
point?this.turn(point,event):point&&this.scene.snap.point([point.x,point.y],{event})}turn(point,event){let{store,gesture}=this,k=store.document.poses.length-1,{
x,y,angle}=standing(store.document,k);if(Math.hypot(point.x-x,point.y-y)*this.scene.view.scale<6)return;let next=this.scene.snap.angle(unwrapped(degrees(Math.atan2(
point.y-y,point.x-x)),angle),[point.x,point.y],{event,skip:k});store.edit(document2=>setPose(document2,k,{angle:next}),{gesture})}key(event){return event.key!==
"Escape"?!1:(this.gesture&&this.store.abandon(this.gesture),this.gesture=null,this.scene.use(null),!0)}};var LONGEST_NAME3=22,ABOVE=10,HATCH=9,PIVOT2={fixed_pivot:"Fixed pivot",moving_pivot:"Moving pivot"};function limitName(document2,{table,key}){return`${PIVOT2[key]}${limitsOf(
document2).length>1?` of dyad ${table+1}`:""}`}function regionShape(region){return region.box?{shape:"box",points:region.box}:region.polygon?{shape:"polygon",points:region.
polygon}:null}var Regions=class{onjudged;constructor(store,scene){this.store=store,this.scene=scene,this.shapes=new Map,scene.layer("regions").append(s("defs",{},
s("pattern",{id:"bs-hatch",width:HATCH,height:HATCH,patternUnits:"userSpaceOnUse",patternTransform:"rotate(45)"},s("path",{class:"bm-hatch",d:`M0 0V${HATCH}`})))),
this.regions=new Kept(s("g"),(key,k)=>this.makeRegion(k),element=>this.shapes.get(element).draw()),this.footprint=new Kept(s("g"),()=>this.makeFootprint(),element=>this.
shapes.get(element).draw()),this.limits=new Kept(s("g"),(key,limit)=>this.makeLimit(limit),element=>this.shapes.get(element).draw()),this.names=new Kept(s("g",{
class:"bs-region-names","aria-hidden":"true"}),()=>s("text",{}),(text,name)=>this.showName(text,name)),scene.layer("regions").append(this.regions.group,this.footprint.
group),scene.layer("limits").append(this.limits.group),scene.layer("labels").append(this.names.group),store.on("document",()=>this.judge(store.state==="dragging"&&
!this.isOther())),store.on("selection reference",()=>this.draw()),store.on("solved followed chosen placed",()=>this.judge()),scene.on("view",()=>this.draw()),scene.
hold(()=>limitRegions(store.document).filter(({shape})=>shape!=="line").flatMap(each=>this.corners(each))),scene.hold(()=>regionsOf(store.document).map(regionShape).
filter(Boolean).flatMap(({shape,points})=>outlineOf(shape,points)),!0),this.judge()}place({key}){return key==="moving_pivot"?referencePlace(this.store):GROUND}corners(limit){
return outlineOf(limit.shape,limit.points).map(point=>act(this.place(limit),point))}isOther(){let{body,keep_out,surroundings}=this.store.document;return[body,keep_out,
surroundings].some((each,k)=>each!==this.judged?.[k])}judge(pivots=!1){let{document:document2,solved}=this.store,linkage=currentLinkage(this.store);this.broken=
linkage?.led?limitsMissed(document2,linkage,solved?.scene??1):null,pivots||(this.judged=[document2.body,document2.keep_out,document2.surroundings],this.touched=
linkage?.led?regionsTouched(document2,linkage,bodyOf(document2)):null),this.draw(),this.onjudged?.()}said(table,key){return this.broken?.[table]?.filter(each=>each.
key===key).map(each=>missedSentence(each,this.store.document.length_unit))??null}draw(){let{document:document2}=this.store,regions=regionsOf(document2),limits=limitRegions(
document2),{footprint}=document2.requirements??{};this.regions.draw(regions.map((region,k)=>[k,k]).filter(([k])=>regionShape(regions[k]))),this.limits.draw(limits.
map(limit=>[`${limit.table} ${limit.key}`,limit])),this.footprint.draw(footprint?[["footprint",footprint]]:[]);for(let[element,handles]of this.shapes)element.parentNode||
(handles.clear(),this.shapes.delete(element));this.names.draw([...regions.map((region,k)=>[`region ${k}`,region.name&&regionShape(region)?{text:region.name,at:middle(
outlineOf(...Object.values(regionShape(region))))}:null]),...limits.map(limit=>[`limit ${limit.table} ${limit.key}`,{text:limitName(document2,limit),at:middleOf(
this.corners(limit),limit.key==="moving_pivot"),off:limit.key==="moving_pivot"?ABOVE:-ABOVE,width:widthOf(this.corners(limit))}]),["footprint",footprint?{text:"\
Footprint",at:middleOf(footprint.polygon??outlineOf("box",footprint.box),!0),off:ABOVE,width:widthOf(footprint.polygon??footprint.box)}:null]].filter(([,name])=>name))}kept(handles){
return this.shapes.set(handles.element,handles),handles.element}makeRegion(k){let{store}=this,handles=new ShapeHandles(this.scene,{className:"bs-region",what:()=>{
let region=regionsOf(store.document)[k];return{...regionShape(region),place:GROUND,name:region.name?`Keep out: ${region.name}`:`Region ${k+1} to keep out of`,selected:store.
selection?.kind==="region"&&store.selection.index===k,state:this.touched?this.touched[k]?"broken":"met":"",data:{region:k}}},set:(points,gesture)=>store.edit(document2=>setRegion(
document2,k,shapeOf(regionShape(regionsOf(document2)[k]).shape,points)),{gesture}),remove:()=>this.removeRegion(k),select:()=>store.select({kind:"region",index:k}),
abandon:gesture=>store.abandon(gesture)});handles.element.insertBefore(s("path",{class:"bs-hatched",fill:"url(#bs-hatch)"}),handles.area);let draw=handles.draw.
bind(handles);return handles.draw=()=>{draw(),handles.element.querySelector(".bs-hatched").setAttribute("d",handles.line.getAttribute("d"))},this.kept(handles)}removeRegion(k){
this.store.edit(document2=>removeRegion(document2,k)),this.store.select(null),this.scene.svg.focus({preventScroll:!0})}makeLimit({table,key}){let{store}=this,place=()=>this.
place({key}),at=()=>limitRegions(store.document).findIndex(each=>each.table===table&&each.key===key);return this.kept(new ShapeHandles(this.scene,{className:`bs\
-limit bs-${key.replace("_","-")}`,what:()=>{let index=at(),limit=limitRegions(store.document)[index],said=this.said(table,key);return{...limit,place:place(),name:`\
Limit: ${limitName(store.document,limit)}`,selected:store.selection?.kind==="limit"&&store.selection.index===index,state:said?said.length?"broken":"met":"",data:{
limit:index,plane:key==="moving_pivot"?"M":"F"}}},set:(points,gesture)=>store.edit(document2=>setLimit(document2,table,{[key]:shapeOf(Object.keys(limitsOf(document2)[table][key])[0],
points)}),{gesture}),remove:()=>this.removeLimit(table,key),select:()=>store.select({kind:"limit",index:at()}),abandon:gesture=>store.abandon(gesture)}))}removeLimit(table,key){
this.store.edit(document2=>setLimit(document2,table,{[key]:void 0})),this.store.select(null),this.scene.svg.focus({preventScroll:!0})}makeFootprint(){let{store}=this,
shape=()=>Object.keys(store.document.requirements.footprint)[0];return this.kept(new ShapeHandles(this.scene,{className:"bs-footprint",what:()=>({shape:shape(),
points:store.document.requirements.footprint[shape()],place:GROUND,name:"Footprint: holds all pivots",selected:store.selection?.kind==="footprint",data:{footprint:""}}),
set:(points,gesture)=>store.edit(document2=>setRequirement(document2,"footprint",{[shape()]:points}),{gesture}),remove:()=>{store.edit(document2=>setRequirement(
document2,"footprint",void 0)),store.select(null)},select:()=>store.select({kind:"footprint",index:0}),abandon:gesture=>store.abandon(gesture)}))}showName(text,{
text:name,at:[x,y],off,width}){let{scene}=this,{view}=scene,shown2=shortened(name,LONGEST_NAME3);say(text,shown2),put(text,"class",off?"bs-limit-name":"bs-regio\
n-name"),scene.names.put(text,view.X(x),view.Y(y),shown2,off?along(off,view.scale*(width??0)):[[0,0,0]])}regionTool(shape){let{store}=this;return new ShapeTool(
this.scene,{shape,name:`region ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>addRegion(document2,{[shape]:points})),store.select({kind:"region",
index:regionsOf(store.document).length-1})}})}limitTool(table,key,shape){let{store}=this;return new ShapeTool(this.scene,{shape,name:`limit ${table} ${key} ${shape}`,
place:()=>this.place({key}),at:key==="moving_pivot"?atReference(store):"",done:points=>{store.edit(document2=>setLimit(document2,table,{[key]:shapeOf(shape,points)})),
store.select({kind:"limit",index:limitRegions(store.document).findIndex(each=>each.table===table&&each.key===key)})}})}footprintTool(shape){let{store}=this;return new ShapeTool(
this.scene,{shape,name:`footprint ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>setRequirement(document2,"footprint",{[shape]:points})),store.select(
{kind:"footprint",index:0})}})}};function middle(points){let[x,y,u,v]=bounds(points);return[(x+u)/2,(y+v)/2]}function middleOf(points,upper){let[x,y,u,v]=bounds(
points);return[(x+u)/2,upper?v:y]}function widthOf(points){let[x,,u]=bounds(points);return Number.isFinite(u-x)?u-x:0}var ORDERS={rank:{name:"best first",of:linkage=>linkage.rank??1/0},worst:{name:"worst miss",of:linkage=>linkage.worst??1/0},least:{name:"transmission angle",of:linkage=>-(linkage.
least??-1)},size:{name:"size",of:linkage=>linkage.quality?.extent??1/0},sensitivity:{name:"sensitivity",of:linkage=>linkage.quality?.sensitivity??1/0}},FILTERS={
all:{name:"all",holds:()=>!0},usable:{name:"usable",holds:linkage=>linkage.usable},pinned:{name:"pinned",holds:(linkage,pinned)=>pinned.has(linkage.id)}};function arranged(linkages,{
order,filter,type,pinned}){let{of}=ORDERS[order],{holds}=FILTERS[filter];return linkages.filter(each=>holds(each,pinned)&&(!type||each.type===type)).map((each,k)=>({
each,k,key:of(each)})).sort((a,b)=>Number(pinned.has(b.each.id))-Number(pinned.has(a.each.id))||(a.key===b.key?0:a.key-b.key)||a.k-b.k).map(({each})=>each)}var FIGURES=[["worst","worst miss"],["least","transmission"],["size","size"],["sensitivity","sensitivity"]],ResultCard=class{constructor(does){this.name=h("b",{}),
this.type=h("span",{class:"bm-type"}),this.was=h("span",{class:"bs-was"}),this.verdict=h("span",{class:"bm-verdict"}),this.figures=new Map(FIGURES.map(([key])=>[
key,h("dd",{"data-figure":key})])),this.worst=h("dt",{}),this.note=h("span",{class:"bs-card-note"}),this.reason=h("span",{class:"bm-reason"}),this.help=h("span",
{class:"bs-help"}),this.main=h("button",{type:"button",class:"bs-card-main","aria-pressed":"false",onclick:()=>does.choose(this.id)},h("span",{class:"bm-choice-\
head"},this.name," ",this.type," ",this.was),this.verdict,h("dl",{class:"bs-figures"},FIGURES.map(([key,name])=>[key==="worst"?this.worst:h("dt",{},name),this.figures.
get(key)])),this.note,this.reason,this.help),this.pin=h("button",{type:"button",class:"bs-small","aria-pressed":"false",onclick:()=>does.pin(this.id)},"Pin"),this.
compare=h("button",{type:"button",class:"bs-small","aria-pressed":"false",onclick:()=>does.compare(this.id)},"Compare"),this.improve=h("button",{type:"button",class:"\
bs-small",onclick:()=>does.improve(this.id)},"Look near it"),this.letGo=h("button",{type:"button",class:"bs-small",onclick:()=>does.letGo()}),this.better=h("ul",
{class:"bs-better","aria-live":"polite"}),this.element=h("article",{class:"bs-card bm-choice"},this.main,h("div",{class:"bs-card-tools"},this.pin,this.compare,this.
improve,this.letGo),this.better)}show(linkage,{data,old,chosen,pinned,compared}){let{said}=linkage,{classList}=this.element,isPlaced=linkage.id===PLACED;(this.id!==
linkage.id||old)&&this.better.replaceChildren(),this.id!==linkage.id&&(this.id=linkage.id,put(this.element,"data-linkage",linkage.id)),say(this.name,isPlaced?linkage.
called:linkage.id),say(this.type,linkage.type),say(this.was,pastOf(linkage)),say(this.verdict,linkage.gone?"✕ gone":linkage.usable?"✓ usable":"✕ not usable"),
say(this.worst,data.isPath?"path error":"worst miss"),say(this.figures.get("worst"),data.isPath?pathErrorOf(linkage,data):worstOf(linkage,data)),say(this.figures.
get("least"),least(linkage)),say(this.figures.get("size"),said.quality.extent??"–"),say(this.figures.get("sensitivity"),said.quality.sensitivity??"–"),say(this.
note,linkage.gone??(linkage.usable&&linkage.change||(linkage.usable&&!linkage.followed&&linkage.shortcomings?.length?`Falls short: ${linkage.shortcomings.join("\
; ")}`:"")));let reason=linkage.usable||linkage.gone?"":linkage.followed?linkage.reason??"":said.reasons.join("; ");say(this.reason,reason),say(this.help,reason&&
said.help&&!linkage.followed?`What would help: ${said.help}.`:""),classList.toggle("bm-good",linkage.usable&&!linkage.gone),classList.toggle("bm-bad",!linkage.usable||
!!linkage.gone),classList.toggle("bs-gone",!!linkage.gone),classList.toggle("bs-old",old||!!linkage.followed),classList.toggle("bs-chosen",chosen),setPressed(this.
main,chosen),setPressed(this.pin,pinned),setPressed(this.compare,compared),say(this.pin,pinned?"Pinned":"Pin"),give(this.pin,"hidden",isPlaced),give(this.compare,
"hidden",isPlaced||chosen),give(this.improve,"hidden",isPlaced||linkage.usable||old||!!linkage.gone),give(this.letGo,"hidden",!isPlaced),say(this.letGo,linkage.
called==="By hand"?"Let go of the pivots":"Put it away");for(let button2 of[this.pin,this.compare,this.improve])labelled(button2,linkage.id)}tellBetter(sentences){
this.better.replaceChildren(...sentences.map(sentence2=>h("li",{},sentence2)))}};function pastOf({was,shift,isNew,followed}){if(isNew&&!was)return"new";let moved2=shift&&
!followed?`moved ${(100*shift).toFixed(1)} %`:"";return[was?`was ${was}`:"",moved2].filter(Boolean).join(", ")}function least(linkage){let angle=leastOf(linkage);
return angle==="–"?angle:angle==="0°"?"down to 0°":`${angle} or more`}function setPressed(button2,on){put(button2,"aria-pressed",!!on)}function labelled(button2,id){
put(button2,"aria-label",`${button2.textContent}: ${id}`)}var History=class{onchange=()=>{};constructor(kept={past:[],future:[]}){this.past=kept.past.map(value=>({value,gesture:null})),this.future=[...kept.future]}kept(room){
let some=list=>{let out=[];for(let k=list.length-1;k>=0&&(room-=JSON.stringify(list[k]).length)>0;k-=1)out.unshift(list[k]);return out};return{past:some(this.past.
map(({value})=>value)),future:some(this.future)}}record(value,gesture){this.future=[];let last=this.past.at(-1);gesture!==null&&last?.gesture===gesture||(this.past.
push({value,gesture}),this.past.length>500&&this.past.shift(),this.onchange())}undo(value){let last=this.past.pop();return last?(this.future.push(value),last.value):
null}redo(value){let next=this.future.pop();return next===void 0?null:(this.past.push({value,gesture:null}),next)}abandon(gesture){return this.past.at(-1)?.gesture!==
gesture?null:this.past.pop()?.value}get canUndo(){return this.past.length>0}get canRedo(){return this.future.length>0}};var REST2=150,MOST_REST=1e3,MOST_FLYING=1,MOST_SHOWN=6,FEWEST=2,QUICK=1.2,NO_ANSWER={linkages:[],dyads:[],best:[],warnings:[],pivot_map:null,family_map:null,outcome:{
message:"Two poses or more make a task"}},PLACED2="placed",kindOf=({poses,path})=>`${poses.map(({free})=>free?.join("")??"-").join()} ${path?path.closed:""}`,Store=class{solving;placing;solved;constructor({
connection,document:document2,options={},name="task",settings={},filters={},choice=null,picture=null,history=void 0,mostFlying=MOST_FLYING}){this.connection=connection,
this.mostFlying=mostFlying,this.renamed=new Map,this.moved=new Map,this.document=document2,this.options=options,this.name=name,this.settings=settings,this.filters=
filters,this.picture=picture,this.wanted=choice&&{...choice,document:document2},this.history=new History(history),this.history.onchange=()=>this.emit("history"),
this.solved=null,this.solvedFor=null,this.followed=null,this.followedFor=null,this.state="resting",this.progress="",this.chosen=null,this.pinned=new Set,this.compared=
null,this.placed=null,this.whole=null,this.task=0,this.solvedTask=0,this.selection=null,this.reference=0,this.isOnBody=!1,this.messages=[],this.listeners=new Map,
this.basis=null,this.pending=null,this.flying=new Map,this.placing=null,this.solving=null,connection.on("message",message=>this.take(message)),connection.on("op\
en",()=>this.opened()),connection.on("closed",()=>this.closed())}on(names,fn){for(let name of[names].flat().join(" ").split(/\s+/))this.listeners.has(name)||this.
listeners.set(name,[]),this.listeners.get(name).push(fn)}emit(...names){let told=new Set;for(let name of names)for(let fn of this.listeners.get(name)??[])told.has(
fn)||(told.add(fn),fn(name))}edit(change,{gesture=null,options=this.options,picture=this.picture}={}){let next=change(this.document);if(next===this.document)return;
this.history.record(this.version,gesture);let hasMoved=picture!==this.picture;Object.assign(this,{document:next,options,picture}),this.changed(),hasMoved&&this.
emit("picture")}option(name,value){this.history.record(this.version,null);let{[name]:_,...rest}=this.options;this.options=value===void 0?rest:{...rest,[name]:value},
this.changed()}setting(name,value){this.history.record(this.version,null),this.settings=withKeys(this.settings,{[name]:value}),this.emit("document")}rename(name){
this.history.record(this.version,null),this.name=name,this.emit("document")}filter(name,value){this.history.record(this.version,name),this.filters={...this.filters,
[name]:value},this.emit("filters")}setPicture(changes,gesture=null){this.history.record(this.version,gesture),this.picture=changes&&{...this.picture,...changes},
this.emit("picture")}replace({document:document2,options={},name=this.name,settings=this.settings,picture=null}){this.history.record(this.version,null),this.tasks=
(this.tasks??0)+1,this.document=document2,this.options=options,this.name=name,this.settings=settings,this.picture=picture,this.selection=null,this.reference=0,this.
placed=null,this.task=this.tasks,this.changed(),this.emit("selection","placed","reference","picture")}undo(){this.goTo(this.history.undo(this.version))}redo(){this.
goTo(this.history.redo(this.version))}abandon(gesture){this.goTo(this.history.abandon(gesture))}get version(){let{document:document2,options,name,settings,task,
filters,picture,choice}=this;return{document:document2,options,name,settings,task,filters,picture,choice}}get choice(){return{chosen:this.chosen,compared:this.compared,
pinned:[...this.pinned]}}goTo(version){if(!version)return;let{choice,...task}=version,isSame=task.document===this.document&&task.options===this.options;return Object.
assign(this,task),this.emit("filters","picture"),this.wanted={...choice,document:task.document},isSame?(this.solvedFor===task.document&&(this.takeWanted(),this.
showChosen()),this.emit("document")):this.changed()}changed(){this.placed?.cognateOf&&this.letCognateGo(),this.follow(),this.emit("document"),this.isEmpty&&this.
forget(),this.state!=="offline"&&this.setState("dragging"),this.solveAfterRest()}get shown(){return[...new Set([this.chosen,this.compared,...this.pinned])].filter(
id=>id&&id!==PLACED2).slice(0,MOST_SHOWN)}follow(){if(!this.solved||this.flying.size>=this.mostFlying)return;if(!this.canFollow){this.solveMeanwhile();return}let{
document:document2,options,shown:shown2}=this,n=this.connection.send({do:"follow",document:document2,options,shown:shown2});n!==null&&this.flying.set(n,{document:document2,
isOld:!1})}get canFollow(){return this.whole!==kindOf(this.document)}get slow(){return this.canFollow||this.seconds===void 0?null:this.seconds}solveMeanwhile(){
if(this.solving||this.state==="offline"||this.isEmpty||this.slow===null||this.slow>QUICK)return;let{document:document2,options}=this,n=this.connection.send({do:"\
solve",document:document2,options});n!==null&&(this.solving={n,document:document2,options})}solveAfterRest(){clearTimeout(this.resting);let since=performance.now(),
rest=()=>{this.flying.size&&performance.now()-since<MOST_REST?this.resting=setTimeout(rest,REST2/3):this.solve()};this.resting=setTimeout(rest,REST2)}solve(){clearTimeout(
this.resting);let{document:document2,options}=this;if(this.solving?.document===document2&&this.solving.options===options){this.setState("solving","");return}let n=this.
connection.send({do:"solve",document:document2,options});n!==null&&(this.solving={n,document:document2,options},this.setState("solving",""))}cancel(){this.connection.
send({do:"cancel"})}place(pivots){this.placeWanted=pivots?.length?pivots:null,this.placeWanted?this.placing||this.sendPlace():(this.placed=null,this.emit("place\
d"))}sendPlace(){let{document:document2,options,placeWanted:pivots}=this,n=this.connection.send({do:"place",document:document2,options,pivots});this.placing=n===
null?null:{n,pivots}}take(message){let{n,kind}=message;kind==="ended"&&this.say(message.messages.map(each=>({tone:kind,...each}))),kind==="followed"?this.takeFollowed(
message):this.flying.has(n)?this.followRefused(message):n===this.placing?.n?this.takePlaced(message):(n===this.solving?.n||kind==="cancelled"&&this.solving&&n>this.
solving.n)&&this.takeSolving(message)}takeFollowed(frame){let asked=this.flying.get(frame.n);if(!asked)return;let{document:document2,isOld}=asked,from=frame.from??
(isOld?null:this.basis);this.flying.delete(frame.n),this.pending&&from===this.pending.n&&this.install(this.pending),this.goOn(document2);let isThere=document2===
this.solvedFor&&!this.followed;from===this.basis&&!isThere&&(this.followed=frame,this.followedFor=document2,this.emit("followed")),!this.flying.size&&![this.followedFor,
this.solvedFor].includes(this.document)&&this.follow()}goOn(document2){[document2,...[...this.flying.values()].map(each=>each.document)].includes(this.document)||
this.follow()}followRefused({n,kind,messages=[],solve=!1,whole=!1}){let{document:document2}=this.flying.get(n);this.flying.delete(n),kind==="refused"&&!solve&&this.
say(messages),whole&&(this.whole=kindOf(document2)),this.goOn(document2)}takePlaced(message){let{pivots}=this.placing;this.placing=null,this.placeWanted&&message.
kind==="placed"?(this.placed={...message,pivots},this.emit("placed")):message.kind==="refused"&&this.say(message.messages),this.placeWanted&&this.placeWanted!==
pivots&&this.sendPlace()}takeSolving(message){let{document:document2}=this.solving,isNow=document2===this.document,isAnother=this.solvedTask!==this.task;if(message.
kind==="progress"||message.kind==="waiting"){let before=`waiting for ${message.before} other${message.before===1?"":"s"}`;isNow&&this.setState("solving",message.
kind==="progress"?message.text:before);return}if(message.kind!=="solving"){if(this.solving=null,message.kind==="solved"){let answer={...message,document:document2};
isNow||!this.canFollow?this.install(answer):this.pending=answer}else isAnother&&this.forget("There is no answer to this task yet");if(message.kind==="refused")this.
say(message.messages);else if(!["solved","ended"].includes(message.kind)){let[said]=[message.message].flat();this.say([{tone:message.kind,...typeof said=="strin\
g"?{message:said}:said}])}isNow&&this.setState("resting","")}}get isEmpty(){return this.document.poses.length<FEWEST}forget(message=NO_ANSWER.outcome.message){if(!this.
solved)return;let result={...this.solved,...NO_ANSWER,outcome:{message},space:{...this.solved.space,quadrics:[]}};this.install({n:null,result,document:this.document,
seconds:null,was:void 0}),this.placed&&this.place([])}install({n,result,document:document2,seconds,was}){let told=Object.entries(was??{});if(this.renamed=new Map(
told.map(([now,{id}])=>[id,now])),this.moved=new Map(told.map(([now,{moved:moved2}])=>[now,moved2])),!told.length&&document2===this.solvedFor&&!this.followed)for(let{
id}of result.linkages)this.renamed.set(id,id);let carried=id=>id===PLACED2&&this.placed?.linkage?id:this.renamed.get(id)??null;this.isAnother=this.solvedTask!==
this.task,this.solved=result,this.solvedFor=document2,this.solvedTask=this.task,this.seconds=seconds,this.basis=n,this.whole=null,this.pending=null,this.followed=
null,this.followedFor=null;for(let each of this.flying.values())each.isOld=!0;this.chosen=carried(this.chosen)??result.linkages[0]?.id??null,this.compared=carried(
this.compared),this.pinned=new Set([...this.pinned].map(carried).filter(Boolean)),this.wanted?.document===document2&&this.takeWanted(),this.messages=[],this.emit(
"solved","chosen","pinned","messages"),document2!==this.document&&this.follow()}takeWanted(){let{chosen,compared,pinned=[]}=this.wanted,isThere=id=>id===PLACED2?
!!this.placed:this.solved.linkages.some(each=>each.id===id);isThere(chosen)&&(this.chosen=chosen),this.compared=isThere(compared)?compared:null,this.pinned=new Set(
pinned.filter(isThere)),this.wanted=null}takeCognate(linkage,of){this.placeWanted=null,this.placed={linkage,dyads:[],pivots:[],cost:null,messages:[],cognateOf:of},
this.chosen=PLACED2,this.emit("placed","chosen")}letCognateGo(){let{cognateOf}=this.placed;this.placed=null,this.chosen===PLACED2&&(this.chosen=cognateOf),this.
emit("placed","chosen")}opened(){this.flying.clear(),this.solving=this.placing=null,this.setState("resting",""),this.basis=null,this.solve()}closed(){clearTimeout(
this.resting),this.flying.clear(),this.solving=this.placing=null,this.setState("offline","")}setState(state,progress=""){state===this.state&&progress===this.progress||
(this.state=state,this.progress=progress,this.emit("state"))}say(messages){this.messages=messages,this.emit("messages")}choose(id){id!==this.chosen&&(this.history.
record(this.version,"choose"),this.chosen=id,this.showChosen())}showChosen(){this.emit("chosen","pinned"),(this.state==="dragging"||this.document!==this.solvedFor)&&
this.follow()}pin(id){this.history.record(this.version,null),this.pinned.delete(id)||this.pinned.add(id),this.emit("pinned")}compare(id){this.history.record(this.
version,"compare"),this.compared=id===this.compared?null:id,this.emit("chosen")}select(selection){["kind","index","indices"].every(key=>String(selection?.[key])===
String(this.selection?.[key]))||(this.selection=selection,this.emit("selection"))}get selectedPoses(){let{selection,document:document2}=this;return selection?.kind===
"pose"?(selection.indices??[selection.index]).filter(k=>k<document2.poses.length):[]}selectPoses(indices,index=indices.at(-1)){this.select(indices.length?{kind:"\
pose",index:indices.includes(index)?index:indices.at(-1),indices:indices.length>1?indices:void 0}:null)}selectAlso(index){let before=this.selectedPoses;this.selectPoses(
before.includes(index)?before.filter(k=>k!==index):[...before,index],index)}get referenceIndex(){return Math.min(this.reference,this.document.poses.length-1)}setReference(index){
this.reference=index,this.emit("reference")}};var MOST3=40,Results=class{constructor(store,answers){this.store=store,this.answers=answers,this.cards=new Map,this.wanted={order:"rank",filter:"all",type:""},this.
all=!1;let choice=(name,entries,key)=>h("label",{},`${name} `,h("select",{"data-choice":key,onchange:event=>this.want(key,event.target.value)},entries.map(([value,
text])=>h("option",{value},text))));this.types=choice("Type",[["","any"]],"type"),this.title=h("h2",{},"Linkages"),this.status=h("p",{class:"bs-results-status",
role:"status"}),this.doubt=h("p",{class:"bs-doubt"}),this.gone=h("p",{class:"bs-gone-note"}),this.list=h("div",{class:"bs-cards"}),this.more=h("button",{type:"b\
utton",class:"bs-small",hidden:!0,onclick:()=>this.showAll()}),this.element=h("section",{class:"bs-results","aria-label":"Linkages"},h("div",{class:"bs-results-\
head"},this.title,this.status,this.doubt,this.gone,h("div",{class:"bs-choices"},choice("Show",Object.entries(FILTERS).map(([key,{name}])=>[key,name]),"filter"),
choice("Sort by",Object.entries(ORDERS).map(([key,{name}])=>[key,name]),"order"),this.types)),this.list,this.more),this.pace=new Pace(()=>this.update()),this.list.
addEventListener("keydown",event=>this.walk(event)),answers.on("answers placed",()=>this.arrange()),answers.on("moved",()=>this.pace.ask()),answers.on("shown",()=>this.
update()),store.on("pinned",()=>this.arrange()),store.on("state document",()=>this.tell()),this.arrange()}want(key,value){this.wanted[key]=value,this.arrange()}showAll(){
this.all=!0,this.arrange()}arrange(){let{answers,store,wanted}=this;this.buildTypes();let every=arranged(answers.linkages,{...wanted,pinned:store.pinned}),shown2=this.
all?every:every.slice(0,MOST3),list=answers.placed?[answers.placed,...shown2]:shown2,cards=new Map;for(let linkage of list)cards.set(linkage,this.cards.get(linkage)??
this.card());for(let[linkage,card]of this.cards)cards.has(linkage)||card.element.remove();this.cards=cards;let before=null;for(let card of cards.values()){let next=before?
before.nextSibling:this.list.firstChild;card.element!==next&&this.list.insertBefore(card.element,next),before=card.element}give(this.more,"hidden",every.length<=
shown2.length),this.more.hidden||say(this.more,`Show all ${every.length}`),this.hidden=answers.linkages.length-every.length,this.update()}card(){let{store}=this;
return new ResultCard({choose:id=>store.choose(id),pin:id=>store.pin(id),compare:id=>store.compare(id),improve:id=>this.improve(id),letGo:()=>this.letGo()})}letGo(){
this.store.placed?.cognateOf?this.store.letCognateGo():this.store.place([]),this.store.chosen===PLACED&&this.store.choose(this.answers.linkages[0]?.id??null)}buildTypes(){
let types=[...new Set(this.answers.linkages.map(each=>each.type))].sort(),key=types.join(),select=this.types.querySelector("select");key!==this.typesKey&&(this.
typesKey=key,types.includes(this.wanted.type)||(this.wanted.type=""),select.replaceChildren(...["",...types].map(type=>h("option",{value:type,selected:type===this.
wanted.type},type||"any"))),give(this.types,"hidden",types.length<2))}update(){let{answers,store}=this,{data,isOld,shown:shown2}=answers;for(let[linkage,card]of this.
cards)card.show(linkage,{data,old:isOld&&linkage.id!==PLACED,chosen:linkage===shown2,pinned:store.pinned.has(linkage.id),compared:store.compared===linkage.id});
this.tell()}tell(){let{answers,store}=this,there=answers.linkages.filter(each=>!each.gone),usable=there.filter(each=>each.usable).length;say(this.title,there.length?
`${there.length} linkage${there.length===1?"":"s"}, ${usable} usable`:store.solved?"No linkage":"Linkages"),put(this.status,"aria-live",store.state==="dragging"?
"off":"polite"),say(this.status,this.statusText());let uncertain=store.followed?.uncertain??[];say(this.doubt,store.followed&&answers.isOld?uncertain.length?`Ma\
y change when you let go: ${uncertain[0]}${/[.!]$/.test(uncertain[0])?"":"."}`:store.followed.complete===!1?"A linkage that appears now is seen when you let go.":
"":""),say(this.gone,!answers.isOld&&answers.gone.length?`Not in the new answer: ${listed(answers.gone)} of the one before.`:""),this.element.classList.toggle("\
bs-stale",answers.isOld)}statusText(){let{store,answers}=this,hidden=this.hidden?`${this.hidden} not shown by the filter. `:"";if(store.state==="offline")return"\
The connection is gone; what you see is the last answer.";if(answers.isOld&&store.state==="dragging")return store.followed?"Moving along.":this.whenSolved();if(store.
state==="solving")return"Looking for all linkages.";if(!store.solved)return"";let{best,outcome}=store.solved;return store.solved.linkages.some(each=>each.usable)?
`${hidden}${best?.[0]??""}`:`${hidden}${sentence(outcome?.message)}${outcome?.help?` What helps: ${outcome.help}.`:""}`}whenSolved(){let{slow}=this.store;if(slow===
null)return"The new answer comes when you let go.";let took=`All linkages are looked for anew, which took ${slow<.95?"less than a second":`${Math.round(slow)} s`}\
 last time`;return slow>QUICK?`${took}: the new answer comes when you let go.`:`${took}: the answer lags behind your hand by so much.`}async improve(id){let{document:document2,
options,connection}=this.store,card=()=>[...this.cards].find(([linkage])=>linkage.id===id)?.[1];card()?.tellBetter(["Looking near it …"]);let said;try{said=(await(await connection.
post("/improve",{document:document2,options,linkage:id})).json()).better}catch(error){said=[`That did not work: ${error.message}`]}document2===this.store.document&&
card()?.tellBetter(said.length?said.map(nearIt):["Nothing better lies near it."])}walk(event){let step={ArrowDown:1,ArrowRight:1,ArrowUp:-1,ArrowLeft:-1}[event.
key],mains=[...this.cards.values()].map(card=>card.main),at=mains.indexOf(this.list.getRootNode().activeElement);!step||at<0||(event.preventDefault(),mains[clamp(
at+step,0,mains.length-1)].focus())}},nearIt=text=>text.replace(/^L\d+ changes/,"One changes"),sentence=text=>text?`${text[0].toUpperCase()}${text.slice(1)}.`:"";var WAY=["x","y","angle","drive","transmission"],POSE=["x","y","angle_deg","position","turned_deg","transmission_deg"];function decodeFrame(buffer){let length=new DataView(
buffer).getUint32(0,!0),header=JSON.parse(new TextDecoder().decode(new Uint8Array(buffer,4,length))),numbers=floats(buffer,4+length);for(let linkage of header.linkages??
[]){if(linkage.ways&&(linkage.ways=linkage.ways.map(way=>({...way,...pieces(numbers,way,WAY)}))),!linkage.poses)continue;let{count}=linkage.poses,columns=pieces(
numbers,linkage.poses,POSE);linkage.pose_errors=Array.from({length:count},(_,pose)=>{let at=linkage.at?.[pose]??null,row={way:at?at[0]:null,frame:at?at[1]:null};
for(let name of POSE){let value=columns[name][pose];row[name]=Number.isNaN(value)?null:value}return row})}return header}function floats(buffer,start){if(new Uint8Array(
new Uint16Array([1]).buffer)[0]===1)return new Float32Array(buffer,start);let view=new DataView(buffer,start);return Float32Array.from({length:view.byteLength/4},
(_,k)=>view.getFloat32(4*k,!0))}function pieces(numbers,{start,count},names){return Object.fromEntries(names.map((name,k)=>[name,numbers.subarray(start+k*count,
start+(k+1)*count)]))}var PATIENCE=1500,Kernel=class{constructor(model){this.model=model,this.view=Math.random().toString(36).slice(2),this.listeners={message:[],open:[],closed:[],told:[],
busy:[]},this.n=0,this.waiting=null,this.heard=(message,buffers)=>this.take(message,buffers),model.on("msg:custom",this.heard)}on(name,fn){this.listeners[name].
push(fn)}emit(name,value){for(let fn of this.listeners[name])fn(value)}take(message,buffers=[]){message.view!==null&&message.view!==this.view||(this.rest(),message.
n===void 0?this.emit("told",message):this.emit("message",message.kind==="followed"?decodeFrame(bytesOf(buffers[0])):message))}send(message){return this.n+=1,message.
do!=="choose"&&(this.waiting??=setTimeout(()=>this.emit("busy",!0),PATIENCE)),this.model.send({view:this.view,n:this.n,...message}),this.n}rest(){clearTimeout(this.
waiting),this.waiting=null,this.emit("busy",!1)}close(){clearTimeout(this.waiting),this.model.off("msg:custom",this.heard)}};function bytesOf(data){return data instanceof
ArrayBuffer?data:data.buffer.slice(data.byteOffset,data.byteOffset+data.byteLength)}var notebook_default=`/* The widget of a notebook; in a shadow root, after widget.css and studio.css. */

:host { display: block; }
.bm.bn { min-height: 0; font-size: 14px; border: 1px solid var(--bm-line); border-radius: 8px; overflow: hidden; background: var(--bm-panel); }
.bn-main { display: grid; height: 470px; grid-template-columns: minmax(0, 1fr) 236px; }
.bn-left { display: grid; gap: 5px; padding: 7px 10px 8px; min-width: 0; min-height: 0; grid-template: auto minmax(0, 1fr) auto / minmax(0, 1fr); }
.bn-bar { display: flex; gap: 5px; align-items: center; min-width: 0; }
.bs .bn-bar .bm-button { min-height: 28px; min-width: 30px; padding: 1px 8px; font-size: 0.82rem; }
.bm .bn-line { flex: 1; min-width: 0; min-height: 2.6em; max-height: 2.6em; overflow: auto; display: flex; align-items: center; margin-left: 5px; font-size: 0.7\
8rem; line-height: 1.3; color: var(--bm-muted); }
.bm .bn-line.bn-refused { color: var(--bm-bad); }
.bn .bs-plane { height: auto; min-height: 0; }
.bn .bs-scene { touch-action: pan-y; }
.bn .bs-origin, .bn .bs-turn, .bn .bs-corner, .bn .bs-middle { touch-action: none; }
.bn .bs-player { gap: 0; }
.bn .bs-player .bm-row { gap: 4px 8px; }
.bn .bm-now { font-size: 0.76rem; }
.bn .bs-driver-note { display: none; }
.bn-ways { font-size: 0.78rem; }
.bn-ways summary { cursor: pointer; color: var(--bm-accent); width: fit-content; }
.bs.bn .bm-controls { gap: 3px; margin: 0; }
.bs.bn .bm-controls .bm-button { min-height: 28px; padding: 1px 10px; font-size: 0.82rem; }
.bn .bm-controls, .bn .bm-row { font-size: 0.82rem; }
.bn .bs-results { padding: 8px 8px 8px 10px; min-height: 0; align-content: start; grid-template-rows: auto minmax(0, 1fr); gap: 6px; border-left: 1px solid var(\
--bm-line); background: var(--bm-bg); }
.bn .bs-results .bs-choices, .bn .bs-card-tools, .bn .bs-better { display: none; }
.bm.bn .bs-results-status { font-size: 0.76rem; max-height: 6.2em; overflow: auto; }
.bn .bs-cards { grid-template-columns: minmax(0, 1fr); overflow: auto; scrollbar-width: thin; padding: 1px; }
.bn .bs-card { font-size: 0.8rem; }
.bn .bs-card-main { padding-bottom: 9px; }
.bn .bs-card .bm-choice-head { font-size: 0.88rem; }
.bn .bs-figures, .bs.bn .bs-card-note, .bs.bn .bm-reason, .bs.bn .bs-help { font-size: 0.77rem; }
.bn .bm-whole { font-size: 0.8rem; }
.bn .bs-figures dd { white-space: nowrap; }
.bn .bs-gone-note { display: none; }
@container (max-width: 559px) {
  .bn-main { height: auto; grid-template-columns: minmax(0, 1fr); }
  .bn-bar { flex-wrap: wrap; }
  .bm .bn-line { flex-basis: 100%; margin-left: 0; max-height: 4em; }
  .bn .bs-plane { height: 270px; }
  .bn .bs-results { border-left: 0; border-top: 1px solid var(--bm-line); }
  .bn .bs-cards { display: flex; align-items: stretch; overflow-x: auto; padding-bottom: 5px; }
  .bn .bs-card.bm-choice { flex: 0 0 212px; }
}
/* What changes under a hand is laid out by itself. */
.bn { contain: layout style paint; }
.bn .bs-player, .bn .bs-results, .bn-bar { contain: layout style; }
`;var DARK_SCHEME="(prefers-color-scheme: dark)";function dress(root,texts,signal){let sheets=texts.map(text=>{let sheet=new CSSStyleSheet;return sheet.replaceSync(text.replace(/([\d.]+)rem\b/g,(_,size2)=>`${16*
size2}px`)),sheet}),dark=sheets.flatMap(({cssRules})=>[...cssRules]).filter(rule=>rule.media?.mediaText===DARK_SCHEME),follow2=()=>{let on=isDark(root.host);for(let rule of dark)
rule.media.mediaText=on?"all":"not all";root.host.style.colorScheme=on?"dark":"light"},both=()=>{follow2(),setTimeout(follow2,400)},seen2=new MutationObserver(both);
for(let element of[document.documentElement,document.body])seen2.observe(element,{attributes:!0});matchMedia(DARK_SCHEME).addEventListener("change",both,{signal});
let placed=new ResizeObserver(follow2);placed.observe(root.host),signal.addEventListener("abort",()=>[seen2,placed].forEach(each=>each.disconnect())),root.adoptedStyleSheets=
sheets,both()}function isDark(element){for(let node=element;node;node=node.parentElement??node.getRootNode().host){let colour=getComputedStyle(node).backgroundColor,
[r,g,b,a=1]=colour.startsWith("rgb")?(colour.match(/[\d.]+/g)??[]).map(Number):[0,0,0,0];if(a>.5)return .299*r+.587*g+.114*b<128}return matchMedia(DARK_SCHEME).
matches}var MOST_FLYING2=2,PATIENCE2=700,BUSY="The kernel is busy: what is done here is answered when it is free.",HINT="Drag a pose by its point, turn it by the tip of\
 its arrow.",ROOM3="Drag poses by their points, turn them by the tips of their arrows; limits, regions and the body are dragged, too.";function render({model,el}){
let ended=new AbortController,{signal}=ended,kernel=new Kernel(model),host=h("div",{}),frame=h("div",{class:"bm bs bn"},h("p",{class:"bn-line"},"Waiting for the\
 kernel…"));host.attachShadow({mode:"open"}).append(frame),el.replaceChildren(host),dress(host.shadowRoot,[widget_default,studio_default,notebook_default],signal),
keepKeys(host);let studio=null;kernel.on("message",message=>{message.kind==="opened"&&!studio&&(studio=layOut(frame,kernel,message,turn))}),kernel.on("told",message=>{
message.kind==="task"&&message.by!==kernel.view?studio?.replace(message.document):message.kind==="chosen"&&message.id&&studio?.store.choose(message.id)});let turn=()=>{
model.set("turn",model.get("turn")+1),model.save_changes()};return kernel.send({do:"open"}),()=>{ended.abort(),kernel.close(),studio?.playing.player.play(!1),el.
replaceChildren()}}function layOut(frame,kernel,{document:task},turn){let store=new Store({connection:kernel,document:task,mostFlying:MOST_FLYING2}),scene=new Scene(
store,{zoomKey:!0}),answers=new Answers(store),playing=new Playing(store,answers);new LiveLinkage(answers,playing,scene),new BodyEditor(store,scene),new Regions(
store,scene),new PoseHandles(store,scene);let results=new Results(store,answers),left=h("div",{class:"bn-left"},bar(store,scene,kernel),scene.element,playing.element),
ways=playing.element.querySelector(".bs-player-ways"),fold=h("details",{class:"bn-ways"},h("summary",{},"Driver and assembly"));ways.replaceWith(fold),fold.append(
ways),frame.replaceChildren(h("div",{class:"bn-main"},left,results.element)),scene.resize();let refit=fitOnceSolved(store,scene);return listenToKeys(store,scene,
null,frame),listenToSpace(playing,frame),playOnce(store,answers,playing),store.on("chosen",()=>{kernel.send({do:"choose",id:store.chosen,basis:store.basis}),turn()}),
kernel.emit("open"),{store,playing,replace:document2=>{if(JSON.stringify(document2)!==JSON.stringify(store.document))store.replace({document:document2}),refit();else if(store.
solvedFor===store.document)return;store.solve()}}}function bar(store,scene,kernel){let undo=button("↶",()=>store.undo(),{"data-do":"undo",title:"Undo (Ctrl+Z)",
"aria-label":"Undo"}),redo=button("↷",()=>store.redo(),{"data-do":"redo",title:"Redo (Ctrl+Shift+Z)","aria-label":"Redo"}),stop=button("Stop",()=>store.cancel(),
{"data-do":"cancel",title:"Stop solving",hidden:!0}),pose=button("Add poses",()=>scene.use(scene.tool?null:new PoseTool(store,scene)),{"data-do":"add-poses","ar\
ia-pressed":"false"}),line=h("p",{class:"bn-line",role:"status"}),isBusy=!1,show=()=>{give(undo,"disabled",!store.history.canUndo),give(redo,"disabled",!store.history.
canRedo);let[said]=store.messages,solving=store.state==="solving"&&store.progress;put(pose,"aria-pressed",!!scene.tool);let text=isBusy?BUSY:said?[said.message,
said.help].filter(Boolean).join("; "):scene.tool?scene.tool.hint:solving?`Solving: ${store.progress}`:hint(store.document);line.textContent!==text&&(line.textContent=
text),line.classList.toggle("bn-refused",!!said)};kernel.on("busy",on=>{on!==isBusy&&(isBusy=on,show())});let waiting;return store.on("state",()=>{clearTimeout(
waiting),store.state==="solving"?waiting=setTimeout(()=>give(stop,"hidden",!1),PATIENCE2):give(stop,"hidden",!0)}),store.on("document state messages solved",show),
scene.on("tool",show),show(),h("div",{class:"bn-bar"},undo,redo,pose,button("Fit",()=>scene.fitAgain(),{"data-do":"fit",title:"Show all poses and pivots (0)"}),
stop,line)}function hint(document2){return limitRegions(document2).length||regionsOf(document2).length||bodyOf(document2).length?ROOM3:HINT}function fitOnceSolved(store,scene){
let waits=!0;return store.on("solved",()=>{waits&&scene.isFitted&&scene.fit(),waits=!1}),()=>waits=!0}function keepKeys(host){host.addEventListener("keydown",event=>{
(!(event.ctrlKey||event.metaKey)||/^[zy]$/i.test(event.key))&&event.stopPropagation()})}var notebook_default2={render};export{notebook_default2 as default};
