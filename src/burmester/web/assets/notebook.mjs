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
`;var widget_default='.bm {\n  --bm-bg: #f6f6f3; --bm-panel: #ffffff; --bm-ink: #1a1e25; --bm-muted: #5c6470; --bm-line: #dfe1dd; --bm-faint: #eeefec;\n  --bm-drive\
r: #1b5cb8; --bm-follower: #a84a12; --bm-coupler: #4a5869; --bm-plate: #d5dce4;\n  --bm-driver-solid: #5b93dd; --bm-follower-solid: #e09b62;\n  --bm-wanted: #6c75\
80; --bm-error: #b0125f; --bm-good: #196b3c; --bm-bad: #9c3118; --bm-accent: #1b5cb8; --bm-wash: #eaf1fb;\n  --bm-map-near: #5d9c8f; --bm-map-far: #f7f6ee; --bm-\
body: #1c7a6c; --bm-spring: #6b43ab; --bm-hand: #9a5a00;\n  --bm-pair-low: #123570; --bm-pair-middle: #7b7b78; --bm-pair-high: #fde737;\n  --bm-pair-outside: #9fb\
4c7; --bm-pair-order: #d9bfa3; --bm-pair-branch: #dfe2e6; --bm-pair-circuit: #f6f6f4;\n  container-type: inline-size; background: var(--bm-bg); color: var(--bm-i\
nk); font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; min-height: 100vh;\n  font-variant-numeric: tabular-nums;\n}\n@medi\
a (prefers-color-scheme: dark) {\n  .bm {\n    --bm-bg: #121418; --bm-panel: #1a1d23; --bm-ink: #e8eaed; --bm-muted: #a0a8b4; --bm-line: #30353e; --bm-faint: #222\
62d;\n    --bm-driver: #79aefa; --bm-follower: #eda469; --bm-coupler: #b6c1cf; --bm-plate: #353e4a;\n    --bm-driver-solid: #4d86d2; --bm-follower-solid: #cd8548;\
\n    --bm-wanted: #98a2af; --bm-error: #ff7db9; --bm-good: #63cb90; --bm-bad: #ff9277; --bm-accent: #79aefa; --bm-wash: #1f2a3b;\n    --bm-map-near: #4f9c8c; --b\
m-map-far: #1d2128; --bm-body: #55c4b0; --bm-spring: #b795ef; --bm-hand: #f0b04a;\n    --bm-pair-low: #3f74d8; --bm-pair-middle: #a39f92; --bm-pair-high: #fde737\
;\n    --bm-pair-outside: #46586a; --bm-pair-order: #6a5644; --bm-pair-branch: #30363f; --bm-pair-circuit: #1f232a;\n  }\n}\n.bm *, .bm *::before { box-sizing: bord\
er-box; }\n.bm h1, .bm h2, .bm p, .bm dl, .bm dd, .bm ul, .bm fieldset { margin: 0; padding: 0; }\n.bm h1 { font-size: 1.3rem; line-height: 1.2; font-weight: 650;\
 letter-spacing: -0.01em; overflow-wrap: anywhere; }\n.bm h2 { font-size: 0.98rem; line-height: 1.35; font-weight: 650; }\n.bm :focus { outline: none; }\n.bm :focu\
s-visible { outline: 2.5px solid var(--bm-accent); outline-offset: 2px; border-radius: 4px; }\n\n.bm-head { max-width: 1760px; margin: 0 auto; padding: clamp(12px\
, 1.4cqw, 20px) clamp(14px, 2.4cqw, 36px) 2px; display: grid; gap: 4px; }\n.bm .bm-overline { color: var(--bm-muted); font-size: 0.78rem; letter-spacing: 0.04em;\
 }\n.bm-outcome { display: flex; gap: 9px; align-items: baseline; font-size: 1.08rem; max-width: 80rem; }\n.bm-sign { flex: none; width: 1.45em; height: 1.45em; b\
order-radius: 50%; display: inline-grid; place-items: center; font-size: 0.8em; font-weight: 700; color: var(--bm-panel); background: currentColor; }\n.bm-outcom\
e.bm-good .bm-sign { background: var(--bm-good); }\n.bm-outcome.bm-bad .bm-sign { background: var(--bm-bad); }\n.bm-outcome.bm-open .bm-sign { background: var(--b\
m-accent); }\n.bm-code { font-size: 0.78em; color: var(--bm-muted); border: 1px solid var(--bm-line); border-radius: 4px; padding: 0 5px; white-space: nowrap; }\n\
.bm-best, .bm-why { max-width: 68rem; }\n.bm-best { color: var(--bm-ink); }\n.bm-why { color: var(--bm-muted); overflow-wrap: anywhere; }\n.bm-why b { font-weight:\
 600; color: var(--bm-ink); }\n.bm-about summary { cursor: pointer; color: var(--bm-accent); font-size: 0.9rem; width: fit-content; }\n.bm-about[open] { display: \
grid; gap: 4px; padding-bottom: 8px; }\n.bm-found { max-width: 68rem; overflow-wrap: anywhere; }\n.bm .bm-warnings { list-style: none; display: grid; gap: 8px; ma\
rgin-top: 6px; }\n.bm-warnings li { border-left: 3px solid var(--bm-follower); padding: 2px 0 2px 12px; max-width: 68rem; }\n\n.bm-body { max-width: 1760px; margin\
: 0 auto; padding: 12px clamp(14px, 2.4cqw, 36px) 24px; display: grid; gap: 16px; grid-template-columns: minmax(0, 1fr); }\n.bm-main { display: grid; gap: 16px; \
grid-template-columns: minmax(0, 1fr); min-width: 0; align-content: start; }\n.bm-card { background: var(--bm-panel); border: 1px solid var(--bm-line); border-ra\
dius: 10px; padding: 14px 16px 16px; min-width: 0; }\n.bm-story { color: var(--bm-muted); font-size: 0.9rem; margin-top: 2px; }\n.bm .bm-card > .bm-story { margin\
: 2px 0 8px; }\n.bm .bm-stage > .bm-story { min-height: 1.5em; }\n.bm .bm-stage > .bm-drawing { margin-bottom: 10px; }\n.bm-fill { margin-top: 8px; min-width: 0; }\
\n\n.bm-list > h2 { padding: 0 2px 8px; }\n.bm-choices { display: flex; align-items: flex-start; gap: 10px; overflow-x: auto; padding: 3px 3px 10px; margin: -3px; \
scroll-snap-type: x proximity; scrollbar-width: thin; }\n.bm-choice { flex: 0 0 250px; scroll-snap-align: start; display: flex; flex-direction: column; gap: 3px;\
 text-align: left; font: inherit; font-size: 0.86rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 10px; paddin\
g: 10px 12px; cursor: pointer; }\n.bm-choice:hover { border-color: var(--bm-muted); }\n.bm-choice[aria-pressed="true"] { border-color: var(--bm-accent); backgroun\
d: var(--bm-wash); box-shadow: inset 4px 0 0 var(--bm-accent); }\n.bm-choice-head { font-size: 1rem; }\n.bm-choice-head b { font-weight: 700; }\n.bm-verdict { font\
-weight: 600; }\n.bm-quiet { color: var(--bm-muted); font-size: 0.78rem; }\n.bm-good .bm-verdict { color: var(--bm-good); }\n.bm-bad .bm-verdict { color: var(--bm-\
bad); }\n.bm-choice dl { display: grid; grid-template-columns: auto 1fr; gap: 0 10px; }\n.bm-choice dd.bm-links { display: flex; flex-wrap: wrap; justify-content:\
 flex-end; gap: 0 6px; font-size: 0.82rem; line-height: 1.6; }\n.bm-choice dt { color: var(--bm-muted); }\n.bm-choice dd { text-align: right; }\n.bm-whole-word { d\
isplay: inline-block; white-space: pre; }\n.bm-reason, .bm-story, .bm-outcome, .bm-best, .bm-now { overflow-wrap: anywhere; }\n.bm-reason { color: var(--bm-muted)\
; font-size: 0.82rem; line-height: 1.38; border-top: 1px solid var(--bm-line); padding-top: 5px; margin-top: 3px; }\n\n.bm .bm-ways { border: 0; display: flex; fl\
ex-wrap: wrap; gap: 6px 8px; margin: 0 0 8px; align-items: center; font-size: 0.86rem; }\n.bm-ways legend { float: left; padding: 0; margin-right: 6px; color: va\
r(--bm-muted); line-height: 30px; }\n.bm-ways label { position: relative; display: inline-flex; align-items: center; gap: 7px; border: 1px solid var(--bm-line); \
border-radius: 8px; padding: 4px 11px 4px 9px; cursor: pointer; }\n.bm-ways label:has(:checked) { border-color: var(--bm-accent); background: var(--bm-wash); }\n.\
bm-ways label:has(:focus-visible) { outline: 2.5px solid var(--bm-accent); outline-offset: 2px; }\n.bm-ways input { margin: 0; accent-color: var(--bm-accent); ou\
tline: none; flex: none; }\n.bm-ways b { font-weight: 600; }\n.bm-ways b::first-letter { text-transform: uppercase; }\n\n.bm svg { display: block; max-width: 100%; \
}\n.bm text { font: 12px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; fill: var(--bm-ink); font-variant-numeric: tabular-nums; }\n.bm-drawing { borde\
r: 1px solid var(--bm-faint); border-radius: 8px; overflow: hidden; }\n.bm-plane { width: 100%; touch-action: pan-y; }\n.bm .bm-plane:focus-visible, .bm .bm-space\
:focus-visible, .bm .bm-scroll:focus-visible { outline-offset: -3px; border-radius: 8px; }\n.bm-grid path { stroke: var(--bm-faint); fill: none; }\n.bm .bm-grid t\
ext { fill: var(--bm-muted); font-size: 11px; }\n.bm-ghost { fill: var(--bm-body); fill-opacity: 0.06; stroke: var(--bm-body); stroke-width: 1.1; stroke-linejoin\
: round; }\n.bm-body-outline { fill: var(--bm-body); fill-opacity: 0.2; stroke: var(--bm-body); stroke-width: 2; stroke-linejoin: round; }\n.bm-hatch { fill: none\
; stroke: var(--bm-muted); stroke-width: 1.1; }\n.bm-region-plain { fill: var(--bm-muted); fill-opacity: 0.1; }\n.bm-region-edge { stroke: var(--bm-muted); stroke\
-width: 1.5; stroke-linejoin: round; }\n.bm .bm-region-name { font-weight: 600; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 4px; }\n.bm-curve { fi\
ll: none; stroke: var(--bm-coupler); stroke-width: 1.6; }\n.bm-curve.bm-beyond { stroke-width: 1; opacity: 0.5; }\n.bm-curve.bm-same { stroke-dasharray: 6 4; opac\
ity: 0.7; }\n.bm-curve.bm-other { stroke-dasharray: 1.5 4; opacity: 0.75; }\n.bm-pivot-path { fill: none; stroke-width: 1; opacity: 0.42; }\n.bm-pivot-path.bm-side\
0 { stroke: var(--bm-driver); }\n.bm-pivot-path.bm-side1 { stroke: var(--bm-follower); }\n.bm-pivot-path.bm-side-inner { stroke: var(--bm-coupler); }\n.bm-solid { \
fill: var(--bm-panel); stroke: var(--bm-coupler); stroke-width: 1.5; stroke-linejoin: round; }\n.bm-ground { stroke: var(--bm-coupler); stroke-width: 1.4; fill: \
none; }\n.bm-thin { opacity: 0.55; }\n.bm .bm-name { font-weight: 600; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }\n.bm text.bm-side0, .bm b\
.bm-side0, .bm th.bm-side0 { fill: var(--bm-driver); color: var(--bm-driver); }\n.bm text.bm-side1, .bm b.bm-side1, .bm th.bm-side1 { fill: var(--bm-follower); c\
olor: var(--bm-follower); }\n.bm-wanted path { fill: none; stroke: var(--bm-wanted); stroke-width: 1.3; stroke-dasharray: 3.5 2.5; }\n.bm-wanted circle { fill: no\
ne; stroke: var(--bm-wanted); stroke-width: 1.4; }\n.bm-wanted-path { fill: none; stroke: var(--bm-wanted); stroke-width: 1.2; stroke-dasharray: 5 4; stroke-line\
join: round; opacity: 0.75; }\n.bm-achieved path { fill: none; stroke: var(--bm-ink); stroke-width: 1.1; }\n.bm-achieved circle { fill: var(--bm-ink); }\n.bm-elsew\
here { opacity: 0.38; }\n.bm-errors path { fill: none; stroke: var(--bm-error); stroke-width: 1.8; stroke-linejoin: round; stroke-linecap: round; }\n.bm .bm-pose-\
names text { font-weight: 600; fill: var(--bm-muted); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }\n.bm-bar { stroke-width: 11; stroke-line\
cap: round; fill: none; }\n.bm-core { stroke-width: 7.5; stroke-linecap: round; fill: none; }\n.bm-link.bm-side0 .bm-bar { stroke: var(--bm-driver); }\n.bm-link.bm\
-side0 .bm-core { stroke: var(--bm-driver-solid); }\n.bm-link.bm-side1 .bm-bar { stroke: var(--bm-follower); }\n.bm-link.bm-side1 .bm-core { stroke: var(--bm-pane\
l); }\n.bm-inner .bm-bar { stroke: var(--bm-coupler); }\n.bm-inner .bm-core { stroke: var(--bm-panel); }\n.bm-carried .bm-bar { stroke: var(--bm-coupler); stroke-w\
idth: 17; opacity: 0.9; }\n.bm-carried .bm-core { stroke: var(--bm-plate); stroke-width: 14; }\n.bm-key .bm-carried .bm-bar { stroke-width: 13; }\n.bm-key .bm-carr\
ied .bm-core { stroke-width: 10; }\n.bm-ternary { opacity: 0.86; }\n.bm-ternary path { stroke-linejoin: round; }\n.bm-ternary.bm-side0 .bm-core { fill: var(--bm-dr\
iver-solid); fill-opacity: 0.45; }\n.bm-ternary.bm-side1 .bm-core { fill: var(--bm-follower); fill-opacity: 0.12; }\n.bm-ternary.bm-inner .bm-core { fill: var(--b\
m-coupler); fill-opacity: 0.12; }\n.bm-ternary.bm-carried .bm-core { fill: var(--bm-plate); }\n.bm-plate-rim { fill: none; stroke: var(--bm-coupler); stroke-width\
: 17; stroke-linejoin: round; stroke-linecap: round; opacity: 0.9; }\n.bm-plate { fill: var(--bm-plate); stroke: var(--bm-plate); stroke-width: 14; stroke-linejo\
in: round; stroke-linecap: round; }\n.bm-coupler { opacity: 0.86; }\n.bm-spring { fill: none; stroke: var(--bm-spring); stroke-width: 2; stroke-linejoin: round; }\
\n.bm-springs [data-spring="gas"] .bm-spring { fill: var(--bm-panel); fill-opacity: 0.75; }\n.bm-spring-end { fill: var(--bm-spring); }\n.bm-pin-forces { display: \
none; }\n:root:has(.bm-forces:not([hidden]) .bm-show-forces:checked) .bm-pin-forces { display: inline; }\n.bm-pin-force { fill: none; stroke: currentColor; stroke\
-width: 2; stroke-linejoin: round; }\n.bm-pin-newtons { fill: currentColor; font-size: 11px; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }\n.\
bm-forces { display: flex; gap: 6px; align-items: baseline; }\n.bm-forces[hidden] { display: none; }\n.bm-hand { fill: none; stroke: var(--bm-hand); stroke-width:\
 3; stroke-linecap: round; stroke-linejoin: round; }\n.bm-slot-rim { stroke: var(--bm-coupler); stroke-width: 21; stroke-linecap: round; }\n.bm-slot-plate { strok\
e: var(--bm-plate); stroke-width: 18; stroke-linecap: round; }\n.bm-slot-edge { stroke: var(--bm-coupler); stroke-width: 12.5; }\n.bm-slot { stroke: var(--bm-pane\
l); stroke-width: 10; }\n.bm-block rect { stroke-width: 1.6; }\n.bm-block.bm-side0 rect { fill: var(--bm-driver-solid); stroke: var(--bm-driver); }\n.bm-block.bm-s\
ide1 rect { fill: var(--bm-panel); stroke: var(--bm-follower); }\n.bm-pin { fill: var(--bm-panel); stroke: var(--bm-ink); stroke-width: 1.8; }\n.bm-origin { fill:\
 var(--bm-ink); }\n.bm-body-frame { fill: none; stroke: var(--bm-ink); stroke-width: 1.8; }\n.bm .bm-letter { font-weight: 700; font-style: italic; }\n.bm-to-far {\
 cursor: pointer; }\n.bm .bm-error-scale { fill: var(--bm-error); font-size: 11px; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 4px; }\n.bm-far-mar\
k { fill: none; stroke-width: 2.4; stroke-linecap: round; stroke-linejoin: round; }\n.bm-far-mark.bm-side0 { stroke: var(--bm-driver); }\n.bm-far-mark.bm-side1 { \
stroke: var(--bm-follower); }\n.bm-drive-mark { fill: none; stroke: var(--bm-driver); stroke-width: 1.8; stroke-linecap: round; stroke-linejoin: round; }\n\n.bm-co\
ntrols { display: grid; gap: 6px; margin: 0 0 10px; }\n.bm-row { display: flex; flex-wrap: wrap; gap: 8px; align-items: flex-start; }\n.bm-button { font: inherit;\
 font-size: 0.9rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 8px; padding: 5px 11px; min-height: 34px; curs\
or: pointer; display: inline-flex; gap: 7px; align-items: center; white-space: nowrap; }\n.bm-button:hover { border-color: var(--bm-muted); }\n.bm-button:disabled\
 { opacity: 0.45; cursor: default; }\n.bm-play { background: var(--bm-accent); border-color: var(--bm-accent); color: var(--bm-panel); min-width: 92px; justify-c\
ontent: center; font-weight: 600; }\n.bm-play svg { fill: currentColor; }\n.bm-whole, .bm-real { display: inline-flex; gap: 6px; align-items: center; min-height: \
34px; font-size: 0.9rem; white-space: nowrap; cursor: pointer; }\n.bm-whole input, .bm-real input, .bm-far-pivots input, .bm-close-up input { accent-color: var(-\
-bm-accent); margin: 0; }\n.bm-whole:has(:disabled) { opacity: 0.45; cursor: default; }\n.bm-real[hidden] { display: none; }\n.bm-small-step { padding: 5px 9px; }\n\
.bm-pick { font: inherit; font-size: 0.86rem; color: var(--bm-ink); background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 8px; min-heigh\
t: 34px; padding: 2px 4px; }\n.bm-track { min-width: 0; }\n.bm-slider { display: block; width: 100%; margin: 0 0 2px; height: 18px; accent-color: var(--bm-accent)\
; }\n.bm-stops { width: 100%; overflow: visible; }\n.bm-stops path { stroke: var(--bm-muted); }\n.bm .bm-stops text { font-size: 10.5px; fill: var(--bm-muted); pai\
nt-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }\n.bm-now { display: block; font-size: 0.88rem; min-height: 1.5em; }\n.bm-now span { display: inlin\
e-block; max-width: 100%; }\n.bm-under { display: flex; flex-wrap: wrap; gap: 8px 18px; justify-content: space-between; align-items: flex-end; margin-top: 10px; \
}\n.bm-choose { display: flex; flex-wrap: wrap; gap: 4px 18px; }\n.bm-far-pivots, .bm-close-up { display: inline-flex; gap: 6px; align-items: center; cursor: poin\
ter; }\n.bm-far-pivots[hidden], .bm-close-up[hidden], .bm-ways[hidden] { display: none; }\n.bm-factor { white-space: nowrap; font-size: 0.86rem; color: var(--bm-m\
uted); }\n.bm-factor select { font: inherit; color: var(--bm-ink); background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; padding: 2p\
x 6px; }\n.bm .bm-keys { list-style: none; display: flex; flex-wrap: wrap; gap: 2px 18px; flex: 1 1 260px; font-size: 0.82rem; color: var(--bm-muted); }\n.bm-keys\
 li { display: inline-flex; gap: 6px; align-items: center; }\n.bm-key { flex: none; }\n\n.bm-aside { display: grid; gap: 16px; grid-template-columns: minmax(0, 1fr\
); min-width: 0; }\n.bm-facts { display: grid; font-size: 0.9rem; }\n.bm-facts div { display: flex; justify-content: space-between; gap: 14px; border-bottom: 1px \
solid var(--bm-faint); padding: 2px 0; }\n.bm-facts dt { color: var(--bm-muted); }\n.bm-facts dd { text-align: right; }\n.bm-note-text { font-size: 0.82rem; color:\
 var(--bm-muted); margin-top: 8px !important; }\n.bm-scroll { overflow-x: auto; margin-top: 8px; scrollbar-width: thin; }\n.bm table { border-collapse: collapse; \
width: 100%; font-size: 0.86rem; }\n.bm caption { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }\n.b\
m-dimensions caption, .bm-every caption { position: static; width: auto; height: auto; clip-path: none; text-align: left; font-weight: 600; padding: 6px 0 2px; \
}\n.bm th, .bm td { text-align: right; padding: 3px 12px 3px 0; border-bottom: 1px solid var(--bm-faint); vertical-align: top; white-space: nowrap; font-weight: \
400; }\n.bm thead th { color: var(--bm-muted); border-bottom-color: var(--bm-line); white-space: normal; vertical-align: bottom; }\n.bm tbody th { text-align: lef\
t; font-weight: 650; }\n.bm .bm-words { text-align: left; white-space: normal; }\n.bm .bm-linkages td.bm-words, .bm .bm-pose-table td.bm-words { white-space: nowr\
ap; }\n.bm .bm-linkages th, .bm .bm-linkages td { padding-right: 9px; }\n.bm .bm-linkages td:nth-child(3), .bm .bm-linkages td:nth-child(4) { white-space: normal;\
 }\n.bm .bm-linkages td:last-child { white-space: normal; min-width: 14rem; overflow-wrap: anywhere; }\n.bm .bm-pose-table tbody th { position: sticky; left: 0; b\
ackground: var(--bm-panel); }\n.bm .bm-pose-table tr.bm-current th { background: var(--bm-wash); }\n.bm-scroll:has(.bm-pose-table) { max-height: 34rem; overflow-y\
: auto; }\n.bm th:last-child, .bm td:last-child { padding-right: 2px; }\n.bm tr.bm-current > * { background: var(--bm-wash); }\n.bm .bm-dimensions td { padding-rig\
ht: 8px; }\n.bm .bm-dimensions td:last-child { white-space: normal; padding-right: 0; }\n.bm .bm-numbers .bm-scroll { margin-top: 0; }\n.bm-numbers .bm-facts { mar\
gin-top: 10px; }\n.bm-line-of { display: block; white-space: nowrap; }\n.bm .bm-joints tbody th { white-space: normal; }\n.bm-every { margin-top: 12px; font-size: \
0.9rem; }\n.bm-every summary { cursor: pointer; color: var(--bm-accent); }\n.bm-every-all { display: grid; gap: 6px 28px; grid-template-columns: repeat(auto-fill,\
 minmax(min(100%, 340px), 1fr)); }\n\n.bm-plots { width: 100%; cursor: ew-resize; touch-action: pan-y; }\n.bm-panel { fill: none; stroke: var(--bm-line); }\n.bm-rul\
e { stroke: var(--bm-faint); fill: none; }\n.bm-usual { stroke: var(--bm-muted); stroke-dasharray: 5 4; fill: none; }\n.bm .bm-tick { font-size: 11px; fill: var(-\
-bm-muted); }\n.bm .bm-halo { paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }\n.bm .bm-title { font-size: 12px; fill: var(--bm-muted); }\n.bm .b\
m-note { fill: var(--bm-muted); }\n.bm-stem { stroke: var(--bm-error); stroke-width: 1.6; }\n.bm-dot { fill: var(--bm-error); }\n.bm .bm-dot-name { font-size: 11px\
; font-weight: 600; fill: var(--bm-muted); }\n.bm-line { fill: none; stroke: var(--bm-driver); stroke-width: 1.8; }\n.bm-line.bm-loop1 { stroke: var(--bm-follower\
); stroke-dasharray: 6 4; }\n.bm-stale { opacity: 0.35; }\n.bm-line.bm-curve1 { stroke: var(--bm-follower); stroke-dasharray: 6 4; }\n.bm-line.bm-curve2 { stroke: \
var(--bm-error); }\n.bm-line.bm-curve3 { stroke: var(--bm-good); stroke-dasharray: 6 4; }\n.bm-line.bm-curve4 { stroke: var(--bm-coupler); }\n.bm-line.bm-curve5 { \
stroke: var(--bm-body); stroke-dasharray: 6 4; }\n.bm-line.bm-curve6 { stroke: var(--bm-muted); }\n.bm .bm-title tspan { font-weight: 700; fill: var(--bm-driver);\
 }\n.bm .bm-title .bm-curve1 { fill: var(--bm-follower); }\n.bm .bm-title .bm-curve2 { fill: var(--bm-error); }\n.bm .bm-title .bm-curve3 { fill: var(--bm-good); }\
\n.bm .bm-title .bm-curve4 { fill: var(--bm-coupler); }\n.bm .bm-title .bm-curve5 { fill: var(--bm-body); }\n.bm .bm-title .bm-curve6 { fill: var(--bm-muted); }\n.b\
m-dot.bm-loop0 { fill: var(--bm-driver); }\n.bm-dot.bm-loop1 { fill: var(--bm-follower); }\n.bm-cursor path { stroke: var(--bm-ink); stroke-width: 1.3; }\n.bm-curs\
or circle { fill: var(--bm-panel); stroke: var(--bm-ink); stroke-width: 1.8; }\n\n.bm-map { position: relative; border: 1px solid var(--bm-line); border-radius: 8\
px; overflow: hidden; }\n.bm-map canvas { display: block; width: 100%; }\n.bm-map svg { position: absolute; inset: 0; width: 100%; height: 100%; cursor: crosshair\
; }\n.bm .bm-map svg:focus-visible { outline-offset: -3px; border-radius: 8px; }\n.bm-map-cursor { fill: none; stroke: var(--bm-ink); stroke-width: 2; }\n.bm-cross\
 { stroke: var(--bm-ink); opacity: 0.75; }\n.bm-some-pivot { fill: var(--bm-ink); opacity: 0.55; }\n.bm-its-pivot { fill: var(--bm-panel); stroke-width: 3; }\n.bm-\
its-pivot.bm-side0 { stroke: var(--bm-driver); }\n.bm-its-pivot.bm-side1 { stroke: var(--bm-follower); }\n.bm .bm-map-name { font-weight: 700; paint-order: stroke\
; stroke: var(--bm-panel); stroke-width: 3px; }\n.bm-pairs { display: grid; gap: 16px; }\n.bm-pairs.bm-beside { grid-template-columns: auto auto; justify-content:\
 start; }\n.bm-pairs-map { position: relative; overflow: hidden; }\n.bm-pairs-map canvas { position: absolute; image-rendering: pixelated; }\n.bm-pairs-map svg { p\
osition: absolute; inset: 0; width: 100%; height: 100%; cursor: crosshair; }\n.bm .bm-pairs-map svg:focus-visible { outline-offset: -3px; border-radius: 8px; }\n.\
bm-pairs-scene { border: 1px solid var(--bm-line); border-radius: 8px; display: block; }\n.bm-pairs-axes path, .bm-pairs-axes rect { fill: none; stroke: var(--bm\
-ink); stroke-width: 1; }\n.bm-pairs-axes text { fill: var(--bm-ink); font-size: 11px; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; }\n.bm-pai\
rs-under path { fill: none; stroke: var(--bm-ink); stroke-width: 6; }\n.bm-pairs-curve path { fill: none; stroke-width: 4.4; }\n.bm-pairs-mark { fill: var(--bm-in\
k); stroke: var(--bm-panel); stroke-width: 1; }\n.bm-pair-halo { fill: none; stroke: var(--bm-panel); stroke-width: 5; }\n.bm-pair-halo.bm-thin { stroke-width: 3;\
 }\n.bm-pair-outline { fill: none; stroke: var(--bm-ink); stroke-width: 1.3; }\n.bm-pair-ring { fill: none; stroke: var(--bm-error); stroke-width: 2.4; }\n.bm-pole\
 { fill: var(--bm-ink); stroke: var(--bm-panel); stroke-width: 1; }\n.bm-pair-body { fill: none; stroke: var(--bm-coupler); stroke-width: 2.4; stroke-linejoin: r\
ound; paint-order: stroke; }\n.bm-pair-link { fill: none; stroke-width: 3; stroke-linecap: round; }\n.bm-pair-link.bm-side0 { stroke: var(--bm-driver); }\n.bm-pair\
-link.bm-side1 { stroke: var(--bm-follower); }\n.bm-pair-ground { stroke: var(--bm-panel); stroke-width: 1.4; }\n.bm-pair-ground.bm-side0 { fill: var(--bm-driver)\
; }\n.bm-pair-ground.bm-side1 { fill: var(--bm-follower); }\n.bm-pair-pin { fill: var(--bm-panel); stroke: var(--bm-coupler); stroke-width: 1.6; }\n.bm-pair-scale \
{ display: inline-block; width: 64px; height: 11px; border: 1px solid var(--bm-muted); border-radius: 2px; vertical-align: -1px; background: linear-gradient(to \
right, var(--bm-pair-low), var(--bm-pair-middle), var(--bm-pair-high)); }\n.bm-pair-key { white-space: nowrap; margin-right: 8px; }\n.bm-pair-outside { background\
: var(--bm-pair-outside); }\n.bm-pair-order { background: var(--bm-pair-order); }\n.bm-pair-branch { background: var(--bm-pair-branch); }\n.bm-pair-circuit { backg\
round: var(--bm-pair-circuit); }\n.bm-readout { display: block; }\n.bm-legend, .bm-readout { font-size: 0.82rem; color: var(--bm-muted); }\n.bm .bm-legend { margin\
-top: 8px; }\n.bm-swatch { display: inline-block; width: 14px; height: 11px; border: 1px solid var(--bm-muted); border-radius: 2px; vertical-align: -1px; margin-\
right: 3px; }\n.bm-swatch.bm-far { margin-left: 12px; }\n.bm-near { background: var(--bm-map-near); }\n.bm-far { background: var(--bm-map-far); }\n\n.bm-space { posi\
tion: relative; border: 1px solid var(--bm-faint); border-radius: 8px; touch-action: pan-y; cursor: grab; user-select: none; -webkit-user-select: none; }\n.bm-sp\
ace:active { cursor: grabbing; }\n.bm-space canvas, .bm-space svg { position: absolute; inset: 0; width: 100%; height: 100%; }\n.bm-box { stroke: var(--bm-muted);\
 fill: none; stroke-width: 0.9; opacity: 0.75; }\n.bm-box.bm-behind { stroke-dasharray: 3 4; opacity: 0.5; }\n.bm .bm-axis { font-size: 11px; fill: var(--bm-muted\
); }\n.bm-motion { fill: none; stroke: var(--bm-ink); stroke-width: 2.4; stroke-linecap: round; }\n.bm-motion.bm-other { stroke-width: 1.5; stroke-opacity: 0.75; \
}\n.bm-motion.bm-hidden { stroke-opacity: 0.42; }\n.bm-image-point { fill: var(--bm-panel); stroke: var(--bm-ink); stroke-width: 1.8; }\n.bm-image-point.bm-hidden \
{ opacity: 0.6; }\n.bm .bm-image-name { font-weight: 700; paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; stroke-opacity: 0.8; }\n.bm-runner { fi\
ll: var(--bm-error); stroke: var(--bm-panel); stroke-width: 2; }\n.bm-foot-notes { max-width: 1760px; margin: 0 auto; padding: 0 clamp(14px, 2.4cqw, 36px) 28px; \
color: var(--bm-muted); font-size: 0.82rem; }\n\n@container (max-width: 959px) {\n  .bm-main { display: contents; }\n  .bm-stage { order: -4; }\n  .bm-list { order: \
-2; }\n  .bm-main > .bm-aside, .bm-main > .bm-loaded { order: -3; }\n  .bm-choices { align-items: stretch; }\n  .bm-choice { flex-basis: 264px; }\n  .bm-choice .bm-\
reason, .bm-choice dl dd.bm-detail, .bm-choice dl dt.bm-detail { display: none; }\n}\n@container (max-width: 640px) {\n  .bm-card { padding: 12px 12px 14px; }\n  .b\
m .bm-dimensions { font-size: 0.8rem; }\n  .bm .bm-dimensions td, .bm .bm-dimensions th { padding-right: 6px; }\n  .bm .bm-dimensions td:last-child { padding-righ\
t: 0; }\n  .bm .bm-named tbody th { white-space: normal; min-width: 7rem; max-width: 9rem; overflow-wrap: break-word; }\n  .bm .bm-stacks, .bm .bm-stacks tbody { \
display: block; }\n  .bm .bm-stacks thead { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; }\n  .bm .bm-stacks tr { display\
: block; padding: 6px 0; border-bottom: 1px solid var(--bm-line); }\n  .bm .bm-stacks tbody th, .bm .bm-stacks td { display: flex; justify-content: space-between\
; gap: 14px; border: 0; padding: 1px 0; white-space: normal; text-align: right; min-width: 0; }\n  .bm .bm-stacks td.bm-words, .bm .bm-linkages td:last-child { t\
ext-align: right; white-space: normal; min-width: 0; }\n  .bm .bm-stacks td::before { content: attr(data-head); color: var(--bm-muted); white-space: nowrap; text\
-align: left; }\n  .bm .bm-linkages td:last-child:not(.bm-none) { display: block; text-align: left; color: var(--bm-muted); }\n  .bm .bm-linkages td:last-child::b\
efore { margin-right: 14px; }\n  .bm .bm-stacks td.bm-none { display: none; }\n}\n@container (min-width: 620px) and (max-width: 959px) {\n  .bm-aside { grid-templat\
e-columns: repeat(2, minmax(0, 1fr)); }\n}\n@container (min-width: 960px) {\n  .bm-body:has(.bm-list) { grid-template-columns: 250px minmax(0, 1fr); }\n  .bm-list {\
 position: sticky; top: 0; align-self: start; max-height: 100vh; display: flex; flex-direction: column; padding-top: 4px; }\n  .bm-choices { flex-direction: colu\
mn; align-items: stretch; overflow: hidden auto; padding-bottom: 16px; }\n  .bm-choice { flex: none; }\n  .bm-main { grid-template-columns: repeat(10, minmax(0, 1\
fr)); }\n  .bm-stage, .bm-aside, .bm-loaded, .bm-family-curve, .bm-pose-box, .bm-all, .bm-dyads { grid-column: 1 / -1; }\n  .bm-aside { grid-template-columns: rep\
eat(2, minmax(0, 1fr)); }\n  .bm-image, .bm-pivots, .bm-family-plane { grid-column: span 5; }\n}\n@container (min-width: 1140px) {\n  .bm-stage { grid-column: span \
6; align-self: start; }\n  .bm-aside { grid-column: span 4; grid-template-columns: minmax(0, 1fr); align-self: start; }\n  .bm-main:not(:has(.bm-aside)) .bm-stage\
 { grid-column: 1 / -1; }\n  .bm-main:has(.bm-loaded) { grid-template-rows: auto 1fr; }\n  .bm-main:has(.bm-loaded) .bm-aside { grid-row: span 2; }\n  .bm-loaded {\
 grid-column: span 6; align-self: start; }\n}\n@media print {\n  .bm { --bm-bg: #fff; --bm-panel: #fff; --bm-ink: #000; --bm-muted: #444; --bm-line: #bbb; --bm-fai\
nt: #ddd;\n    --bm-driver: #1b5cb8; --bm-follower: #a84a12; --bm-coupler: #4a5869; --bm-plate: #d5dce4; --bm-driver-solid: #5b93dd; --bm-follower-solid: #e09b62\
;\n    --bm-wanted: #6c7580; --bm-error: #b0125f; --bm-good: #196b3c; --bm-bad: #9c3118; --bm-wash: #fff; --bm-body: #1c7a6c; --bm-spring: #6b43ab; --bm-hand: #9\
a5a00;\n    font-size: 10pt; min-height: 0; }\n  .bm-list, .bm-row, .bm-track, .bm-factor, .bm-ways, .bm-every summary, .bm-about summary, .bm-readout { display: \
none !important; }\n  .bm-body, .bm-body:has(.bm-list) { display: block; padding: 0; }\n  .bm-main { display: block; }\n  .bm-head { padding: 0 0 8px; }\n  .bm-card\
 { border: 0; padding: 8px 0; break-inside: avoid; }\n  .bm-pose-box, .bm-all, .bm-dyads, .bm-every { break-inside: auto; }\n  .bm table { font-size: 8pt; }\n  .bm\
 .bm-scroll { overflow: visible; max-height: none; }\n  .bm .bm-linkages td.bm-words { white-space: normal; min-width: 0; }\n  .bm tr, .bm-every-one { break-insid\
e: avoid; }\n  .bm th, .bm td { padding-right: 6px; }\n  .bm-foot-notes { padding: 0; }\n}\n';var clamp=(value,low,high)=>Math.min(Math.max(value,low),high);var degrees=angle=>angle*180/Math.PI;var radians=angle=>angle*Math.PI/180;var px=value=>Math.abs(
value)<1e7?+value.toFixed(5):Math.sign(value)*1e7;function fixed(value,digits){if(value===null||value===void 0||!Number.isFinite(value))return"–";const text=value.
toFixed(digits);return Number(text)===0?text.replace("-",""):text}function figure(value){if(value===null||!Number.isFinite(value))return"–";if(value===0)return"\
0";if(Math.abs(value)>=99.5&&Math.abs(value)<1e6)return value.toFixed(0);const rounded=value.toExponential(1),[digits,power]=rounded.split("e").map(Number);if(power>=
-4&&power<2)return String(Number(rounded));if(power>0)return`${digits}e${power}`;return`${digits}e-${String(-power).padStart(2,"0")}`}function ticks(low,high,about){const rough=(high-low)/Math.max(1,about);const power=10**Math.floor(Math.log10(rough));const step=[1,2,5,10].map(k=>k*power).find(
each=>each>=rough*.999)??10*power;const digits=Math.max(0,-Math.floor(Math.log10(step*1.0001)));const marks=[];for(let k=Math.ceil(low/step-1e-9);k*step<=high+step*
1e-9;k+=1){marks.push({at:k*step,text:fixed(k*step,digits)})}return marks}function listed(words){if(words.length<2)return words.join("");return`${words.slice(0,-1).join(", ")} and ${words[words.length-1]}`}function runs(numbers,names){
const parts=[];for(let k=0;k<numbers.length;){let end=k;while(end+1<numbers.length&&numbers[end+1]===numbers[end]+1)end+=1;if(end-k>=2)parts.push(`${names[numbers[k]-
1]}–${names[numbers[end]-1]}`);else for(let i=k;i<=end;i+=1)parts.push(names[numbers[i]-1]);k=end+1}return listed(parts)}var SVG="http://www.w3.org/2000/svg";function furnish(node,attributes,children){for(const[name,value]of Object.entries(attributes??{})){if(value===null||value===
void 0||value===false)continue;if(name.startsWith("on"))node.addEventListener(name.slice(2),value);else node.setAttribute(name,value===true?"":value)}node.append(
...children.flat(Infinity).filter(child=>child!==null&&child!==void 0));return node}var h=(tag,attributes,...children)=>furnish(document.createElement(tag),attributes,
children);var s=(tag,attributes,...children)=>furnish(document.createElementNS(SVG,tag),attributes,children);function put(node,name,value){const text=String(value);
if(node.getAttribute(name)!==text)node.setAttribute(name,text)}function give(node,name,value){const next=typeof node[name]==="boolean"?Boolean(value):String(value);
if(node[name]!==next)node[name]=next}function say(node,text){const next=String(text);if(node.textContent!==next)node.textContent=next}var decimalsOf=data=>clamp(4-Math.ceil(Math.log10(data.scene)),0,12);var poseName=pose=>pose.label===pose.name?pose.name:`${pose.label}: ${pose.name}`;var isPoint=pose=>pose.
angle_deg===null;var nounOf=({poses,stop=void 0})=>stop??(poses.length&&poses.every(isPoint)?"point":"pose");var calledOf=pose=>pose.called??`${isPoint(pose)?"point":"pose"} ${poseName(pose)}`;var shortened=(text,most)=>text.length>most?`${text.slice(0,most-1).trimEnd()}\
…`:text;function missOf(position,angle,unit){if(position==="-")return"–";const[away,...share]=position.split(" (");const length=[away==="exact"?away:`${away}${unit}`,
...share].join(" (");return angle==="free"||position==="exact"&&angle==="exact"?length:`${length} and ${angle}`}function wayName(way,linkage){const circuits=new Set(linkage.ways.map(each=>each.circuit)).size;const parts=[];if(circuits>1||way.branches<2)parts.push(`assembl\
y ${way.circuit}`);if(way.branches>1)parts.push(`branch ${way.branch}`);return parts.join(", ")}function withKeys(object,changes){const copy={...object,...changes};for(const[key,value]of Object.entries(changes))if(value===void 0)delete copy[key];return copy}
var replaced=(list,index,value)=>list.map((each,k)=>k===index?value:each);var without=(list,index)=>list.filter((_,k)=>k!==index);var inserted=(list,index,value)=>[
...list.slice(0,index),value,...list.slice(index)];var withList=(document2,key,list)=>withKeys(document2,{[key]:list.length?list:void 0});var filled=table=>Object.
keys(table).length?table:void 0;var EXACT={x:0,y:0,angle_deg:0};var FEWEST_TRACED=10;var isFree=(pose,key)=>Boolean(pose?.free?.includes(key))||pose?.tolerance?.[key]===
"free";var isPoint2=pose=>isFree(pose,"angle");var isOfPoints=({poses})=>poses.length>0&&poses.every(isPoint2);var isPath=document2=>isOfPoints(document2)&&(document2.
path!==void 0||document2.poses.length>=FEWEST_TRACED);var setPath=(document2,changes)=>withKeys(document2,{path:withKeys(document2.path??{closed:false},changes)});var isExact=tolerance=>tolerance&&["x","y","angle_deg"].every(key=>!tolerance[key]);function settled(document2){const{poses,path,tolerance}=document2,some=poses.
some(pose=>pose.free?.length);return withKeys(document2,{path:path&&poses.length&&!poses.every(isPoint2)?void 0:path,tolerance:some?tolerance??EXACT:isExact(tolerance)?
void 0:tolerance})}var withCrank=(document2,change)=>document2.path?.crank_deg?setPath(document2,{crank_deg:change(document2.path.crank_deg)}):document2;function betweenCranks(angles,index){
const[a,b]=[angles[index-1],angles[index]];if(a!==void 0&&b!==void 0)return(a+b)/2;return a===void 0?(b??0)-10:a+(a-(angles[index-2]??a-10))}var setPose=(document2,index,changes)=>withKeys(
document2,{poses:replaced(document2.poses,index,withKeys(document2.poses[index],changes))});var addPose=(document2,pose,index=document2.poses.length)=>settled(withCrank(
withKeys(document2,{poses:inserted(document2.poses,index,pose)}),angles=>inserted(angles,index,betweenCranks(angles,index))));var removePose=(document2,index)=>settled(
withCrank(withKeys(document2,{poses:without(document2.poses,index)}),angles=>without(angles,index)));var setBody=(document2,corners)=>withList(document2,"body",corners);var bodyOf=document2=>Array.isArray(document2.body)?document2.body:[];var regionsOf=document2=>document2.
keep_out===void 0?[]:[document2.keep_out].flat();var addRegion=(document2,region)=>withList(document2,"keep_out",[...regionsOf(document2),region]);var setRegion=(document2,index,changes)=>withList(
document2,"keep_out",replaced(regionsOf(document2),index,withKeys(regionsOf(document2)[index],changes)));var removeRegion=(document2,index)=>withList(document2,
"keep_out",without(regionsOf(document2),index));var limitsOf=document2=>document2.limits===void 0?[]:[document2.limits].flat();function setLimit(document2,index,changes){const tables=limitsOf(document2),changed=withKeys(
tables[index]??{},changes);const all=index<tables.length?replaced(tables,index,changed):[...tables,changed];const kept=all.length>1||filled(changed)?all:[];return withKeys(
document2,{limits:kept.length>1?kept:kept[0]})}var limitRegions=document2=>limitsOf(document2).flatMap((table,index)=>["fixed_pivot","moving_pivot"].filter(key=>table[key]).map(key=>{const[[shape,points]]=Object.
entries(table[key]);return{table:index,key,shape,points:shape==="point"?[points]:points}}));var shapeOf=(shape,points)=>({[shape]:shape==="point"?points[0]:points});
var setRequirement=(document2,key,value)=>withKeys(document2,{requirements:filled(withKeys(document2.requirements??{},{[key]:value}))});function component(poses,index,key){
if(Number.isFinite(poses[index][key]))return poses[index][key];const before=poses.slice(0,index).findLastIndex(pose=>Number.isFinite(pose[key]));const behind=poses.
slice(index+1).findIndex(pose=>Number.isFinite(pose[key]))+index+1;const[a,b]=[poses[before]?.[key],behind>index?poses[behind][key]:void 0];if(a===void 0||b===void 0)
return a??b??0;return a+(index-before)/(behind-before)*(b-a)}function standing({poses},index){const{x,y,angle}=poses[index];if(Number.isFinite(x)&&Number.isFinite(
y)&&Number.isFinite(angle))return{x,y,angle};return{x:component(poses,index,"x"),y:component(poses,index,"y"),angle:component(poses,index,"angle")}}var poseName2=({
poses},index)=>poses[index]?.name??String(index+1);var statedOf=(pose,changes)=>Object.fromEntries(Object.entries(changes).filter(([key])=>Number.isFinite(pose[key])));var Events=class{heard;on(names,fn){this.heard??=new Map;for(const name of names.split(" "))this.heard.set(name,[...this.heard.get(name)??[],fn])}emit(name,...values){
for(const fn of this.heard?.get(name)??[])fn(...values)}};var LONGEST_NAME=5;var FOLLOWED=1e-7;var EXACT_TURN=1e-5;var UNSEEN=1e-6;var PLACED="placed";var NOTHING={poses:[],body:null,keep_out:[],loads:null,scene:1,unit:null,
dyads:[],linkages:[],dyads_title:"Dyads",chart:{origin:[0,0],angle:0,length:1},space:{centre:[0,0,0],half:[1,1,1],quadrics:[]},pivot_map:null,family_map:null,transmission_limit:{
deg:40,said:"40°, a usual limit"},keys:[],table:null,best:[],warnings:[],footnotes:""};var Answers=class extends Events{constructor(store){super();this.store=store;
this.data={...NOTHING};this.linkages=[];this.gone=[];this.byId=new Map;this.placed=null;store.on("solved",()=>this.takeSolved());store.on("followed",()=>this.takeFollowed());
store.on("document",()=>this.takePoses());store.on("chosen",()=>this.emit("shown"));store.on("placed",()=>this.takePlaced());this.takePoses();if(store.solved)this.
takeSolved()}get shown(){return this.get(this.store.chosen)??(this.store.chosen===PLACED?void 0:this.linkages[0])}get(id){return id===PLACED?this.placed??void 0:
this.byId.get(id)}get isOld(){return this.store.solvedFor!==this.store.document}takePoses(){const poses=posesOf(this.store.document);Object.assign(this.data,{poses,
isPath:isPath(this.store.document),...surroundingsOf(this.store.document,this.data)});this.emit("poses")}takeSolved(){const{solved,document:document2}=this.store,
before=this.linkages.filter(each=>!each.gone);const{renamed:names,moved}=this.store;const was=new Map([...names].map(([old,id])=>[id,this.byId.get(old)]));const{
poses,body,keep_out,...rest}=solved;Object.assign(this.data,{body,keep_out,...rest,poses:posesOf(document2)});this.gone=this.store.isEmpty||this.store.isAnother?
[]:before.filter(each=>!names.has(each.id)).map(each=>each.id);this.byId=new Map;this.linkages=solved.linkages.map(fresh=>{const kept=was.get(fresh.id),now=kept??
{};const stood=kept&&kept.rank!==Infinity;const before2=stood&&kept.id!==fresh.id?kept.id:null;for(const key of Object.keys(now))delete now[key];Object.assign(now,
figured(linked(fresh)),{was:before2,shift:moved.get(fresh.id)??0,isNew:this.known&&!this.store.isAnother&&!stood,followed:false,gone:null,change:null});this.byId.
set(now.id,now);return now});this.known=!this.store.isEmpty;this.emit("answers")}takeFollowed(){const frame=this.store.followed;if(!frame)return;for(const each of frame.
linkages){let now=this.byId.get(each.id);if(now&&each.fresh===false)continue;if(!now){now=appeared(each);this.byId.set(each.id,now);this.linkages.push(now);this.
hasNew=true}follow(now,each,this.data)}for(const{id,message}of frame.vanished??[]){const now=this.byId.get(id);if(now)Object.assign(now,{gone:message,usable:false})}
for(const{id,kind,message}of frame.changes??[]){const now=this.byId.get(id);if(now&&kind!=="vanished")now.change=message}if(this.hasNew){this.hasNew=false;this.
emit("answers")}else{this.emit("moved")}}takePlaced(){const placed=this.store.placed?.linkage,{cognateOf}=this.store.placed??{},called=cognateOf?`Cognate of ${cognateOf}`:
"By hand";const before=this.placed;this.placed=placed?Object.assign(before??{},figured(linked(placed)),{id:PLACED,called,gone:null,followed:false}):null;this.emit(
"placed");if(this.store.chosen===PLACED)this.emit(before&&placed?"moved":"shown")}};var linked=linkage=>({...linkage,pose_errors:linkage.pose_errors.map(row=>({
...row,at:row.way===null?null:linkage.ways[row.way]}))});var figured=linkage=>Object.assign(linkage,{worst:linkage.position_error.max,least:linkage.min_transmission_angle_deg.
range});function posesOf({poses=[]}){const names=poses.map((pose,k)=>pose.name||String(k+1));const short=names.every(name=>name.length<=LONGEST_NAME);return poses.
map((pose,k)=>({...pose,angle_deg:isPoint2(pose)?null:pose.angle,name:names[k],label:short?names[k]:String(k+1)}))}var surroundingsOf=(document2,data)=>({body:Array.
isArray(document2.body)?document2.body:document2.body===void 0?null:data.body});function follow(now,each,data){now.usable=each.usable;now.led=each.led;now.worst=
each.worst;now.least=each.transmission_deg;now.reason=each.reason;now.followed=true;now.gone=null;if(each.type)now.type=each.type;if(!each.ways?.length){now.ways=
now.ways??[];return}now.ways=each.ways;now.pose_errors=each.pose_errors.map(row=>({...row,at:row.way===null?null:each.ways[row.way],said:row.x===null?{position:"\
-",turned:"-",transmission:"-"}:{position:row.position<FOLLOWED*data.scene?"exact":figure(row.position),turned:row.turned_deg<EXACT_TURN?"exact":`${figure(row.turned_deg)}\
°`,transmission:row.transmission_deg===null?"-":`${fixed(row.transmission_deg,1)}°`}}))}var appeared=each=>({id:each.id,type:each.type??"linkage",rank:Infinity,
dyads:each.led,ways:[],pose_errors:[],isNew:true,followed:true,said:{met:"",story:"",facts:[],reasons:[],quality:{},dimensions:[],notes:[],links:null,manifolds:[
[],[]],worst:"–",rms:"–",transmission:"-"},space:null,shortcomings:[],defects:[],unmet:[]});function worstOf(linkage,data){if(linkage.worst===null||linkage.
worst===void 0)return"–";if(!linkage.followed)return linkage.said.worst==="-"?"–":linkage.said.worst==="exact"?"exact":`${linkage.said.worst}${data.unit?` ${data.
unit}`:""}`;return linkage.worst<FOLLOWED*data.scene?"exact":`${figure(linkage.worst)}${data.unit?` ${data.unit}`:""}`}function pathErrorOf(linkage,data){const{
rms}=linkage.said,worst=worstOf(linkage,data);return linkage.followed||!rms||rms==="-"||rms==="exact"?worst:`${rms} rms, ${worst} at most`}function leastOf(linkage){
if(!linkage.followed)return linkage.said.transmission==="-"?"–":linkage.said.transmission;return linkage.least===null||linkage.least===void 0?"–":`${Math.floor(
10*linkage.least+1e-6)/10}°`}var AXIS=26;var BLOCK=[22,14];var transform=(x,y,angle)=>`translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;function foot(){let hatch="";for(let k=-2;k<=
2;k+=1)hatch+=`M${5.5*k+3} 16l-6 7`;return s("g",{class:"bm-foot"},s("path",{class:"bm-solid",d:"M0 0L-10 16H10Z"}),s("path",{class:"bm-ground",d:`M-16 16H16${hatch}`}))}
function axes(length){const l=length,head=Math.max(4,.22*length);return`M0 0H${l}m${-head} ${-head/2}l${head} ${head/2}l${-head} ${head/2}M0 0V${-.6*l}`}function hull(points){const sorted=[...points].sort((p,q)=>p[0]-q[0]||p[1]-q[1]);const half=list=>{const kept=[];for(const point of list){while(kept.length>1){const[
a,b]=kept.slice(-2);if((b[0]-a[0])*(point[1]-a[1])-(b[1]-a[1])*(point[0]-a[0])>0)break;kept.pop()}kept.push(point)}return kept.slice(0,-1)};const corners=[...half(
sorted),...half(sorted.reverse())];return corners.length?corners:sorted.slice(0,1)}function act(place,[x,y]){const c=Math.cos(place.a),d=Math.sin(place.a);return[place.x+c*x-d*y,place.y+d*x+c*y]}function back(place,[x,y]){const c=Math.cos(place.
a),d=Math.sin(place.a);return[c*(x-place.x)+d*(y-place.y),-d*(x-place.x)+c*(y-place.y)]}var normalOf=dyad=>{const angle=radians(dyad.line.normal_deg);return[Math.
cos(angle),Math.sin(angle)]};function constraint(dyad,place){if(dyad.kind==="PP"){const away=place.a-radians(dyad.angle_deg);return[away-2*Math.PI*Math.round(away/
(2*Math.PI)),0,0,1]}if(dyad.kind==="RP"){const[nx2,ny2]=normalOf(dyad);const c=Math.cos(place.a),d=Math.sin(place.a);const tx=c*nx2-d*ny2,ty=d*nx2+c*ny2;const ax=dyad.
fixed_pivot[0]-place.x,ay=dyad.fixed_pivot[1]-place.y;return[tx*ax+ty*ay-dyad.line.offset,-tx,-ty,tx*ay-ty*ax]}const[x,y]=act(place,dyad.moving_pivot);let nx,ny,
residual;if(dyad.kind==="RR"){const ax=x-dyad.fixed_pivot[0],ay=y-dyad.fixed_pivot[1];const size2=Math.hypot(ax,ay)||1;[nx,ny,residual]=[ax/size2,ay/size2,size2-
dyad.radius]}else{[nx,ny]=normalOf(dyad);residual=nx*x+ny*y-dyad.line.offset}return[residual,nx,ny,(x-place.x)*ny-(y-place.y)*nx]}function project(dyads,place,length){let{x,y,a}=place;for(let step=0;step<4;step+=1){const[f,...p]=constraint(dyads[0],{x,y,a});const[g,...q]=constraint(dyads[1],
{x,y,a});p[2]/=length;q[2]/=length;const pp=p[0]*p[0]+p[1]*p[1]+p[2]*p[2];const pq=p[0]*q[0]+p[1]*q[1]+p[2]*q[2];const qq=q[0]*q[0]+q[1]*q[1]+q[2]*q[2];const det=pp*
qq-pq*pq;if(!(det>1e-9*pp*qq))return{x,y,a};const u=(f*qq-g*pq)/det,v=(g*pp-f*pq)/det;x-=u*p[0]+v*q[0];y-=u*p[1]+v*q[1];a-=(u*p[2]+v*q[2])/length;if(Math.abs(f)+
Math.abs(g)<1e-14*length)break}return{x,y,a}}function catmullRom(values,i,share,round){const last=values.length-1;const at=k=>{if(k>=0&&k<=last)return values[k];
if(!round)return k<0?2*values[0]-values[-k]:2*values[last]-values[2*last-k];const wrap=k<0?k+last:k-last;return values[wrap]+(k<0?-1:1)*(values[last]-values[0])};
const[p,q,r,t]=[at(i-1),at(i),at(i+1),at(i+2)];return q+share/2*(r-p+share*(2*p-5*q+4*r-t+share*(3*(q-r)+t-p)))}function placeAt(linkage,way,u,length){if(way.joints)
return placeOfJoints(linkage,way,way.joints,u);const stop=linkage.pose_errors.find(row=>row.at===way&&Math.abs(row.frame-u)<1e-6);if(stop)return{x:stop.x,y:stop.
y,a:radians(stop.angle_deg)};const i=clamp(Math.floor(u),0,way.x.length-2),share=u-i;const place={x:catmullRom(way.x,i,share,way.round),y:catmullRom(way.y,i,share,
way.round),a:catmullRom(way.angle,i,share,way.round)};return project(linkage.led,place,length)}function placeOfJoints({ground},way,moving,u){const at=values=>smooth(
values,u),joints={...ground};for(const[name,[x,y]]of Object.entries(moving))joints[name]=[at(x),at(y)];return{x:at(way.x),y:at(way.y),a:at(way.angle),joints}}function smooth(values,u){
const count=Math.min(6,values.length),first=clamp(Math.floor(u)-2,0,values.length-count);let sum=0;for(let j=0;j<count;j+=1){let weight=1;for(let k=0;k<count;k+=
1)if(k!==j)weight*=(u-first-k)/(j-k);sum+=weight*values[first+j]}return sum}function linear(values,u){const i=clamp(Math.floor(u),0,values.length-2),share=u-i;const before=values[i],
after=values[i+1];if(before===null||after===null)return null;const value=before+share*(after-before);return Number.isNaN(value)?null:value}function valueAt({x,y,
stems=false},at){if(at===null)return null;const here=x.findIndex(each=>Math.abs(each-at)<1e-6);if(here>=0)return y[here];return stems||!(at>x[0]&&at<x[x.length-
1])?null:linear(y,frameAt(x,at))}function frameAt(values,wanted){let low=0,high=values.length-1;if(wanted<=values[low])return low;if(wanted>=values[high])return high;
while(high-low>1){const middle2=low+high>>1;if(values[middle2]<=wanted)low=middle2;else high=middle2}const step=values[high]-values[low];return low+(step>0?(wanted-
values[low])/step:0)}var COILS=9;var LEAD=.15;var BARREL=.6;var HALF_WIDTH=6;var LEAST_ARROW=16;var LONGEST_ARROW=62;var RADIUS=11;var TURNS=2.25;var LONGEST_FORCE=90;var LEAST_FORCE=2;
var BARB=[9,4.5];function springPath(kind,[x,y],[u,v]){const length=Math.hypot(u-x,v-y)||1,across=[-HALF_WIDTH*(v-y)/length,HALF_WIDTH*(u-x)/length];const at=(share,side)=>`${px(
x+share*(u-x)+side*across[0])} ${px(y+share*(v-y)+side*across[1])}`;if(kind==="constant")return`M${at(0,0)}L${at(1,0)}`;if(kind==="gas")return`M${at(0,1)}L${at(
BARREL,1)}L${at(BARREL,-1)}L${at(0,-1)}ZM${at(BARREL,0)}L${at(1,0)}`;const teeth=Array.from({length:2*COILS+1},(_,k)=>at(LEAD+(1-2*LEAD)*k/(2*COILS),k%(2*COILS)?
k%2?1:-1:0));return`M${[at(0,0),...teeth,at(1,0)].join("L")}`}function roundPath(kind,[x,y]){if(kind!=="torsion")return`M${px(x-RADIUS)} ${px(y)}a${RADIUS} ${RADIUS}\
 0 1 0 ${2*RADIUS} 0a${RADIUS} ${RADIUS} 0 1 0 ${-2*RADIUS} 0h${2*RADIUS}M${px(x)} ${px(y-RADIUS)}v${2*RADIUS}`;const points=Array.from({length:55},(_,k)=>[k/54*
RADIUS,k/54*2*Math.PI*TURNS]);return`M${points.map(([r,turn])=>`${px(x+r*Math.cos(turn))} ${px(y-r*Math.sin(turn))}`).join("L")}`}function markPoints({loads},places){
if(!loads)return[];const ends=loads.springs.flatMap(spring=>spring.ends),on=name=>ends.filter(({link})=>link===name).map(({point})=>point);return[...on("ground"),
...places.flatMap(place=>[...on("body"),...loads.hand?[loads.hand]:[]].map(point=>act(place,point)))]}function arrowPath([x,y],angle,length){const c=Math.cos(angle),
d=-Math.sin(angle),tip=[x+length*c,y+length*d];const barb=side=>`${px(tip[0]-BARB[0]*c-side*BARB[1]*d)} ${px(tip[1]-BARB[0]*d+side*BARB[1]*c)}`;return`M${px(x)}\
 ${px(y)}L${tip.map(px).join(" ")}M${barb(1)}L${tip.map(px).join(" ")}L${barb(-1)}`}var LoadMarks=class{constructor(){this.springs=s("g",{class:"bm-springs"});this.
hand=s("path",{class:"bm-hand"});this.forces=s("g",{class:"bm-pin-forces"});this.group=s("g",{class:"bm-loads"},this.springs,this.hand,this.forces)}shape(data,linkage,view){
this.view=view;this.loads=data.loads??null;this.known=(linkage.followed?null:linkage.loads)??null;const springs=this.loads?.springs??[];while(this.springs.children.
length>springs.length)this.springs.lastChild?.remove();while(this.springs.children.length<springs.length)this.springs.append(s("g",{},s("path",{class:"bm-spring"}),
s("circle",{class:"bm-spring-end",r:2.6}),s("circle",{class:"bm-spring-end",r:2.6})));springs.forEach(({kind,ends},k)=>{const[,...marks]=this.springs.children[k].
children;put(this.springs.children[k],"data-spring",kind);for(const mark of marks)put(mark,"visibility",ends.length>1?"inherit":"hidden")});const pins=this.known?.
pins??[];this.greatest=Math.max(0,...pins.flatMap(({force:[x,y]})=>x.map((each,i)=>each===null||y[i]===null?0:Math.hypot(each,y[i]))));this.forces.replaceChildren(
...pins.map(({name})=>s("g",{"data-pin":name},s("path",{class:"bm-pin-force"}),s("text",{class:"bm-pin-newtons"}))))}show(place,drive){const{loads,view}=this;if(!loads||
!view){put(this.hand,"d","");return}loads.springs.forEach(({kind,ends},k)=>{const at=ends.map((end,j)=>this.endOf(end,k,j,place,drive)),group=this.springs.children[k];
put(group,"visibility",at.every(Boolean)?"inherit":"hidden");if(!at.every(Boolean))return;put(group.children[0],"d",at.length>1?springPath(kind,at[0],at[1]):roundPath(
kind,at[0]));at.forEach(([x,y],j)=>{put(group.children[j+1],"cx",px(x));put(group.children[j+1],"cy",px(y))})});(this.known?.pins??[]).forEach((pin,k)=>this.showForce(
this.forces.children[k],pin,drive));const pushes=this.known?.hand,angle=pushes&&drive!==null?valueAt(pushes,drive):null;if(!loads.hand||angle===null)put(this.hand,
"d","");else{const force=valueAt({x:pushes.x,y:pushes.force},drive)??0,size2=LEAST_ARROW+(LONGEST_ARROW-LEAST_ARROW)*Math.abs(force);put(this.hand,"d",arrowPath(
this.seen(act(place,loads.hand)),force<0?angle+Math.PI:angle,size2))}}showForce(group,{at,force},drive){const place=drive===null?[null]:at.map(each=>valueAt(each,
drive)),[x,y]=drive===null?[null,null]:force.map(each=>valueAt({x:at[0].x,y:each},drive));const known=place.every(each=>each!==null)&&x!==null&&y!==null,size2=known?
Math.hypot(x,y):0,long=this.greatest?LONGEST_FORCE*size2/this.greatest:0;put(group,"visibility",long>LEAST_FORCE?"inherit":"hidden");if(!(long>LEAST_FORCE))return;
const from=this.seen(place),c=x/size2,d=y/size2;put(group.children[0],"d",arrowPath(from,Math.atan2(y,x),long));put(group.children[1],"x",px(from[0]+(long+6)*c));
put(group.children[1],"y",px(from[1]-(long+6)*d+4));put(group.children[1],"text-anchor",c<-.3?"end":c>.3?"start":"middle");group.children[1].textContent=`${group.
dataset.pin} ${Number(size2.toPrecision(3))} N`}seen([x,y]){const{view}=this;return view?[view.X(x),view.Y(y)]:[0,0]}endOf({link,point},spring,end,place,drive){
if(link==="ground")return this.seen(point);if(link==="body")return this.seen(act(place,point));const known=this.known?.moved.find(each=>each.spring===spring&&each.
end===end);const at=known&&drive!==null?known.at.map(each=>valueAt(each,drive)):[null];return at.some(each=>each===null)?null:this.seen(at)}};var LEAST_STRETCH=1e-6;function stretchOf(linkage,index,whole=false){const last=(linkage?.ways[index]?.x.length??2)-1,frames=linkage.pose_errors.filter(row=>row.
way===index).map(row=>row.frame);const low=frames.reduce((a,b)=>Math.min(a,b),last),high=frames.reduce((a,b)=>Math.max(a,b),0);const isApart=high-low>LEAST_STRETCH,
sense=frames[frames.length-1]<frames[0]?-1:1;return{...isApart&&!whole?{low,high}:{low:0,high:last},sense,isApart}}function driveAtTime({time:{x,y}},time){return y[0]<=y[y.length-1]?valueAt({x:y,y:x},time):valueAt({x:[...y].reverse(),y:[...x].reverse()},time)}function alongLine(dyad,place){
const[nx,ny]=normalOf(dyad);const[x,y]=dyad.kind==="PR"?act(place,dyad.moving_pivot):back(place,dyad.fixed_pivot);return nx*y-ny*x}function travelOf(dyad,places){
const along2=places.map(place=>alongLine(dyad,place));return[along2.reduce((a,b)=>Math.min(a,b)),along2.reduce((a,b)=>Math.max(a,b))]}function pointOnLine(dyad,along2){
const[nx,ny]=normalOf(dyad),{offset}=dyad.line;return[offset*nx-along2*ny,offset*ny+along2*nx]}var WIDEST=4;var ROOM=2.5;var SPARE=.75;var MOST_PLACES=400;var INSET=12;var bounds=points=>points.reduce(([x,y,u,v],[a,b])=>Number.isFinite(a+b)?[Math.min(x,a),Math.min(y,b),Math.max(u,a),Math.max(v,
b)]:[x,y,u,v],[Infinity,Infinity,-Infinity,-Infinity]);var placesAtPoses=(data,linkage)=>data.poses.flatMap((pose,k)=>{const row=linkage?.pose_errors[k],at=row&&
row.x!==null?row:pose;return at.angle_deg===null?[]:[{x:at.x,y:at.y,a:radians(at.angle_deg),k}]});function farFrom(data){const[x,y,u,v]=bounds(data.poses.map(pose=>[
pose.x,pose.y])),reach=(data.body??[]).reduce((most,[a,b])=>Math.max(most,Math.hypot(a,b)),0);return point=>!(Math.hypot(point[0]-(x+u)/2,point[1]-(y+v)/2)<Math.
max(WIDEST*data.scene,reach))}function pivotsAt(linkage,places){const fixed2=linkage.led.flatMap(dyad=>dyad.fixed_pivot?[dyad.fixed_pivot]:[]);const own=linkage.
led.flatMap(dyad=>dyad.moving_pivot?[dyad.moving_pivot]:dyad.kind==="RP"&&places.length?travelOf(dyad,places).map(end=>pointOnLine(dyad,end)):[]);return[...fixed2,
...places.flatMap(place=>[...own.map(point=>act(place,point)),...Object.values(place.joints??{})])]}function nearPoints(data,linkage,places,{far=false,close=false}={}){
const isFar=farFrom(data),seen2=point=>far||!isFar(point);const reached=linkage?[...linkage.pose_errors.filter(row=>row.x!==null),...places]:[];const points=[...[
...data.poses,...reached].map(({x,y})=>[x,y]),...linkage?[...pivotsAt(linkage,places),...markPoints(data,places)]:[]];const some=places.filter((place,k)=>k%Math.
ceil(places.length/MOST_PLACES)===0&&seen2([place.x,place.y]));const corners=data.body&&!close?[...placesAtPoses(data,linkage),...some].flatMap(place=>data.body.
map(corner=>act(place,corner))):[];return[...points.filter(seen2),...corners]}function fitted(near2,others,whole){const all=bounds([...near2,...others]);const[x,
y,u,v]=bounds(near2),size2=Math.max(u-x,v-y)||1,reach=SPARE*size2;if(whole||!near2.length||Math.max(all[2]-all[0],all[3]-all[1])<=ROOM*size2)return all;return[Math.
max(all[0],x-reach),Math.max(all[1],y-reach),Math.min(all[2],u+reach),Math.min(all[3],v+reach)]}function viewOf(box,width,height,margin){const scale=Math.min((width-2*margin)/(box[2]-box[0]),(height-2*margin)/(box[3]-box[1]));const left=width/2-scale*(box[0]+
box[2])/2,top=height/2+scale*(box[1]+box[3])/2;return{scale,left,top,width,height,X:x=>left+scale*x,Y:y=>top-scale*y}}function edgeTowards({X,Y,width,height},at){
const x=X(at[0]),y=Y(at[1]),cx=width/2,cy=height/2;if(x>=0&&y>=0&&x<=width&&y<=height)return null;const size2=Math.hypot(x-cx,y-cy),u=(x-cx)/size2,v=(y-cy)/size2;
const reach=Math.min((cx-INSET)/Math.abs(u),(cy-INSET)/Math.abs(v));return{x:cx+reach*u,y:cy+reach*v,angle:Math.atan2(-v,u)}}var MANY_GHOSTS=6;var closed=(points,view,[x,y])=>`M${points.map(each=>`${px(x+view.scale*each[0])} ${px(y-view.scale*each[1])}`).join("L")}Z`;var bodyOutline=(data,view)=>closed(
data.body,view,[0,0]);var hasGhost=(k,count)=>count<=MANY_GHOSTS||k===0||k===count-1;var LEAST=250;var SHARE=8;var Pace=class{timer;constructor(work,wanted=()=>true){this.work=work;this.wanted=wanted;this.free=0;this.timer=null;paces.add(this)}ask(){
if(this.timer!==null||!this.wanted())return;this.timer=setTimeout(()=>this.now(),Math.max(0,this.free-performance.now()))}catchUp(){if(this.timer!==null)this.now()}now(){
clearTimeout(this.timer);this.timer=null;const start=performance.now();this.work();const end=performance.now();this.free=end+Math.max(LEAST,SHARE*(end-start))}};
var shown=new WeakMap;function isOther(element,facts){const before=shown.get(element);shown.set(element,facts);return before?.length!==facts.length||facts.some(
(fact,k)=>!Object.is(fact,before[k]))}var paces=new Set;var LETTER=7.2;var HEIGHT=14;var REST=80;var MANY=60;var OUTSIDE=500;var HABIT=6;var MISLEADING=60;var SAME=2;function around(text,toward,distance,few=false){const half=(LETTER*
text.length+4)/2,places=[],count=few?8:16;for(let ring=0;ring<(few?1:3);ring+=1){for(let k=0;k<count;k+=1){const turn=(k%2?1:-1)*Math.ceil(k/2)*(2*Math.PI/count),
angle=toward+turn,away=distance+9*ring;places.push([(away+half-5)*Math.cos(angle),away*Math.sin(angle),3*Math.abs(turn)+14*ring])}}return places}function along(up,width){
const reach=Math.max(0,width/2-30);return[0,-.5,.5,-1,1].flatMap(share=>[[share*reach,up,8*Math.abs(share)],[share*reach,-up,10+8*Math.abs(share)]])}var NamePlaces=class{timer;constructor(scene){
this.scene=scene;this.names=new Map;this.obstacles=[];this.timer=null;scene.on("dropped",()=>this.ask())}avoid(fn){this.obstacles.push(fn)}get areMany(){return this.
names.size>MANY}put(element,x,y,text,places){const before=this.names.get(element),name={x,y,text,places,at:before?.text===text?before.at:places[0]};this.names.set(
element,name);this.show(element,name);this.ask()}ask(){clearTimeout(this.timer);if(!this.scene.dragged)this.timer=setTimeout(()=>this.place(),REST)}show(element,{
x,y,at}){put(element,"text-anchor","middle");put(element,"transform",`translate(${px(x+at[0])} ${px(y-at[1]+4)})`)}place(){if(this.scene.dragged)return;for(const element of[
...this.names.keys()])if(!element.isConnected)this.names.delete(element);const{width,height}=this.scene.view;const seen2=[...this.names].filter(([element,{x,y}])=>x>
-20&&y>-20&&x<width+20&&y<height+20&&element.getAttribute("display")!=="none");const taken=this.obstacles.flatMap(fn=>fn()).map(boxOf),stands=new Map;for(let pass=0;pass<
(this.areMany?1:2);pass+=1){for(const[element,name]of seen2){stands.delete(element);const others=[...stands.values()];let best={cost:Infinity,at:name.at,box:[0,
0,0,0]};for(const at of name.places){const box=boxAt(name,at);const habit=at[0]===name.at[0]&&at[1]===name.at[1]?HABIT:0;let cost=at[2]-habit;if(box[0]<2||box[1]<
2||box[2]>width-2||box[3]>height-2)cost+=OUTSIDE;for(const other of taken)cost+=overlap(box,other);for(const other of others)cost+=SAME*overlap(box,other);const own=awayFrom(
box,name);if(seen2.some(([,other])=>other!==name&&awayFrom(box,other)<own+1))cost+=MISLEADING;if(cost<best.cost)best={cost,at,box}}name.at=best.at;stands.set(element,
best.box)}}for(const[element,name]of seen2)this.show(element,name)}};var boxOf=([x,y,width,height])=>[x-width/2,y-height/2,x+width/2,y+height/2];var boxAt=({x,y,
text},at)=>boxOf([x+at[0],y-at[1],LETTER*text.length+4,HEIGHT]);var awayFrom=(box,{x,y})=>Math.hypot(Math.max(box[0]-x,0,x-box[2]),Math.max(box[1]-y,0,y-box[3]));
function overlap(one,other){const across=Math.min(one[2],other[2])-Math.max(one[0],other[0]),down=Math.min(one[3],other[3])-Math.max(one[1],other[1]);return across>
0&&down>0?across*down:0}var LAYERS=["grid","regions","ghosts","map","curves","paths","mechanism","limits","pivots","poses","labels","tool"];var MARGIN=46;var ZOOM=1.0018;var WIDEST2=1e6;
var CLICK=4;var RAW=8;var Scene=class{view;constructor(store,{zoomKey=false}={}){this.store=store;this.zoomKey=zoomKey;this.listeners={view:[],click:[],tool:[],
dropped:[],closer:[]};this.tool=null;this.dragged=null;this.layers=new Map(LAYERS.map(name=>[name,s("g",{class:`bs-layer bs-layer-${name}`})]));this.layers.get(
"grid").setAttribute("aria-hidden","true");this.svg=s("svg",{class:"bs-scene",tabindex:0,role:"group","aria-label":"The plane: poses, linkage and limits. Arrow \
keys pan, plus and minus zoom, 0 fits."},...this.layers.values());this.element=h("div",{class:"bs-plane"},this.svg);this.size={width:640,height:480};this.origin=
{scale:1,left:320,top:240};this.isFitted=true;this.pointers=new Map;this.boxes=[];this.names=new NamePlaces(this);this.update();this.listen();store.on("document",
()=>this.unit===store.document.length_unit||this.grid());new ResizeObserver(()=>this.resize()).observe(this.element);addEventListener("scroll",()=>this.box=null,
{capture:true,passive:true})}layer(name){return this.layers.get(name)}on(name,fn){this.listeners[name].push(fn)}emit(name,...values){return this.listeners[name].
map(fn=>fn(...values)).some(Boolean)}hold(fn,far=false){this.boxes.push({fn,far})}update(){const{width,height}=this.size,{scale,left,top}=this.origin;this.view=
{scale,left,top,width,height,X:x=>left+scale*x,Y:y=>top-scale*y,x:X=>(X-left)/scale,y:Y=>(top-Y)/scale};Object.assign(this.svg.dataset,{scale,left,top,fit:this.
isFitted?this.isWhole?"all":"near":""});this.grid();this.emit("view",this.view)}resize(){this.box=null;const{width,height}=this.svg.getBoundingClientRect();if(!width||
!height||width===this.size.width&&height===this.size.height)return;this.origin={...this.origin,left:this.origin.left+(width-this.size.width)/2,top:this.origin.top+
(height-this.size.height)/2};this.size={width,height};put(this.svg,"viewBox",`0 0 ${width} ${height}`);if(this.isFitted)this.fit(this.isWhole);else this.update()}pan(dx,dy){
this.isFitted=false;this.origin={...this.origin,left:this.origin.left+dx,top:this.origin.top+dy};this.update()}zoom(factor,X,Y){const fitted2=this.fittedScale??
this.origin.scale;const scale=clamp(this.origin.scale*factor,fitted2/WIDEST2,fitted2*WIDEST2),by=scale/this.origin.scale;this.isFitted=false;this.origin={scale,
left:X+by*(this.origin.left-X),top:Y+by*(this.origin.top-Y)};this.update()}fit(whole=false){const pointsOf=isFar=>this.boxes.filter(({far})=>far===isFar).flatMap(
({fn})=>fn());this.isWhole=whole;this.isFitted=true;this.fitBox(fitted(pointsOf(false),pointsOf(true),whole))}fitBox(box){const[x,y,u,v]=Number.isFinite(box[0])?
box:[-50,-50,50,50],size2=.1*(Math.max(u-x,v-y)||Math.max(1,Math.abs(u),Math.abs(v)));const{width,height}=this.size,wide=Math.max(0,size2-u+x)/2,high=Math.max(0,
size2-v+y)/2;const{scale,left,top}=viewOf([x-wide,y-high,u+wide,v+high],width,height,Math.min(MARGIN,width/8));this.fittedScale=scale;this.origin={scale,left,top};
this.update()}fitAgain(){this.fit(this.isFitted&&!this.isWhole)}closeUp(points){this.isFitted=false;this.fitBox(bounds(points))}reveal(point){const{view}=this,margin=Math.
min(MARGIN,view.width/8);this.closeUp([point,[view.x(margin),view.y(margin)],[view.x(view.width-margin),view.y(view.height-margin)]])}grid(){const{view}=this,{width,
height}=view,group=this.layer("grid");const name=this.unit=this.store.document.length_unit,unit=name?` ${name}`:"";const across=ticks(view.x(0),view.x(width),width/
110),up=ticks(view.y(height),view.y(0),height/80);const lines=[...across.map(({at})=>`M${px(view.X(at))} 0V${height}`),...up.map(({at})=>`M0 ${px(view.Y(at))}H${width}`)];
const origin=`M${px(clamp(view.X(0),-9,width+9))} 0V${height}M0 ${px(clamp(view.Y(0),-9,height+9))}H${width}`;group.replaceChildren(s("path",{class:"bs-grid-lin\
e",d:lines.join("")}),s("path",{class:"bs-grid-axis",d:origin}),...across.filter(({at})=>view.X(at)>46&&view.X(at)<width-(unit?54:30)).map(({at,text})=>s("text",
{x:px(view.X(at)),y:height-6,"text-anchor":"middle"},text)),...up.filter(({at})=>view.Y(at)>30&&view.Y(at)<height-24).map(({at,text})=>s("text",{x:6,y:px(view.Y(
at)-4)},text)),s("text",{x:6,y:14},`y${unit}`),s("text",{x:width-6,y:height-6,"text-anchor":"end"},`x${unit}`))}get grain(){return 10**Math.floor(Math.log10(.35/
this.view.scale))}rounded(value){const{grain}=this,digits=clamp(-Math.round(Math.log10(grain)),0,12);return Number((Math.round(value/grain)*grain).toFixed(digits))+
0}get step(){const[x,y,u,v]=bounds(this.store.document.poses.map(pose=>[pose.x??0,pose.y??0]));const span=Math.hypot(u-x,v-y);return Number.isFinite(span)&&span>
0?10**Math.floor(Math.log10(span/50)):1}at(event){if(!this.box){this.box=this.svg.getBoundingClientRect();if(!this.dragged)requestAnimationFrame(()=>this.dragged||
(this.box=null))}const{left,top}=this.box,X=event.clientX-left,Y=event.clientY-top;return{X,Y,x:this.view.x(X),y:this.view.y(Y)}}drag(element,{start=()=>true,move,
end=()=>{},cancel=()=>{},click=()=>{}}){element.addEventListener("pointerdown",event=>{if(event.button!==0||this.tool||this.dragged)return;event.preventDefault();
event.stopPropagation();element.focus?.({preventScroll:true});const from=this.at(event),ended=new AbortController,{signal}=ended;let begun=false;const stop=finish=>{
ended.abort();this.dragged=this.box=null;this.svg.classList.remove("bs-grasped");if(this.svg.hasPointerCapture?.(event.pointerId))this.svg.releasePointerCapture(
event.pointerId);finish();this.emit("dropped")};this.dragged={cancel:()=>stop(()=>begun&&cancel())};this.capture(event);const on=(name,fn)=>this.svg.addEventListener(
name,each=>each.pointerId===event.pointerId&&fn(each),{signal});let last=from,then=event.timeStamp;const go=each=>{const point=this.at(each);if(point.X===last.X&&
point.Y===last.Y)return;last=point;then=each.timeStamp;if(!begun){if(Math.hypot(point.X-from.X,point.Y-from.Y)<CLICK)return;begun=start(from,event)!==false;if(!begun)
return stop(()=>{});this.svg.classList.add("bs-grasped")}move(point,each)};on("pointermove",go);on("pointerrawupdate",each=>each.timeStamp-then>=RAW&&go(each));
on("pointerup",each=>stop(()=>begun?end(this.at(each)):click(event)));on("pointercancel",()=>stop(()=>begun&&cancel()))})}use(tool){const before=this.tool;this.
tool=tool??null;before?.end?.();this.svg.classList.toggle("bs-drawing",Boolean(tool));this.emit("tool",this.tool);if(tool)this.svg.focus({preventScroll:true})}listen(){
const{svg}=this;svg.addEventListener("wheel",event=>{if(this.zoomKey&&!event.ctrlKey&&!event.metaKey)return;event.preventDefault();const{X,Y}=this.at(event),unit=event.
deltaMode===1?16:1;this.zoom(ZOOM**(-event.deltaY*unit*(event.ctrlKey&&!this.zoomKey?4:1)),X,Y)},{passive:false});svg.addEventListener("pointerdown",event=>this.
press(event));svg.addEventListener("pointermove",event=>this.moved(event));for(const name of["pointerup","pointercancel"])svg.addEventListener(name,event=>this.
released(event));svg.addEventListener("keydown",event=>this.key(event))}capture({pointerId}){try{this.svg.setPointerCapture(pointerId)}catch{}}press(event){if(event.
button!==0&&event.button!==1)return;const{X,Y}=this.at(event);this.pointers.set(event.pointerId,{X,Y,from:{X,Y},button:event.button});if(this.pointers.size>1)for(const each of this.
pointers.values())each.panned=true;this.capture(event)}moved(event){const point=this.at(event),held=this.pointers.get(event.pointerId);if(!held){if(!this.dragged)
this.tool?.hover?.(point);return}const before={X:held.X,Y:held.Y};Object.assign(held,{X:point.X,Y:point.Y});if(this.pointers.size===2){const[one,other]=this.pointers.
values(),still=held===one?other:one;const[now,then]=[point,before].map(({X,Y})=>Math.hypot(X-still.X,Y-still.Y));if(then>0)this.zoom(now/then,(point.X+still.X)/
2,(point.Y+still.Y)/2);return}held.panned||=Math.hypot(point.X-held.from.X,point.Y-held.from.Y)>CLICK;if(!held.panned)return;if(this.tool?.drag?.(point,held))return;
this.svg.classList.add("bs-grasped");this.pan(point.X-before.X,point.Y-before.Y)}released(event){const held=this.pointers.get(event.pointerId);if(!held)return;this.
pointers.delete(event.pointerId);this.svg.classList.remove("bs-grasped");const point=this.at(event);if(event.type==="pointercancel")this.tool?.hover?.(null);else if(held.
panned)this.tool?.release?.(point,held);else if(held.button===0)this.tool?this.tool.click(point,event):this.emit("click",point,event)}key(event){if(event.target!==
this.svg||event.ctrlKey||event.metaKey||event.altKey)return;const by=event.shiftKey?160:40,{width,height}=this.size;const steps={ArrowLeft:[by,0],ArrowRight:[-by,
0],ArrowUp:[0,by],ArrowDown:[0,-by]};if(steps[event.key])this.pan(...steps[event.key]);else if(event.key==="+"||event.key==="=")this.zoom(1.25,width/2,height/2);else if(event.
key==="-")this.zoom(.8,width/2,height/2);else if(event.key==="0")this.fitAgain();else if(event.key==="z")this.emit("closer");else return;event.preventDefault()}};
var Kept=class{constructor(group,make,show){this.group=group;this.make=make;this.show=show;this.elements=new Map}draw(items){const kept=new Map;for(const[key,item]of items){
const element=this.elements.get(key)??this.make(key,item);kept.set(key,element);this.show(element,item)}for(const[key,element]of this.elements)if(!kept.has(key))
element.remove();let before=null;for(const element of kept.values()){const next=before?before.nextSibling:this.group.firstChild;if(element!==next||element.parentNode!==
this.group)this.group.insertBefore(element,next);before=element}this.elements=kept}};var ANGLES={"°":1,deg:1,degree:1,degrees:1,rad:180/Math.PI,mrad:.18/Math.PI};var stepOf=(event,step)=>step*(event.shiftKey?10:event.altKey?.1:1);var stepped=(value,by)=>Number((value+by).toPrecision(12));var button=(text,onclick,attributes={})=>h("button",{type:"button",class:"bm-button",onclick,...attributes},text);var cross=([a,b],[c,d])=>a*d-b*c;var minus=([a,b],[c,d])=>[a-c,b-d];var size=([a,b])=>Math.hypot(a,b);function fromSegment(point,start,end){const along2=minus(end,
start),away=minus(point,start),square=along2[0]**2+along2[1]**2;const share=square>0?Math.min(1,Math.max(0,(along2[0]*away[0]+along2[1]*away[1])/square)):0;return size(
minus(away,[share*along2[0],share*along2[1]]))}var boxCorners=([[a,b],[c,d]])=>[[a,b],[c,b],[c,d],[a,d]];var outlineOf=(shape,points)=>shape==="box"?boxCorners(
points):points;function isInside([x,y],corners){let inside=false;corners.forEach(([a,b],k)=>{const[c,d]=corners[(k+1)%corners.length];if(b>y!==d>y&&x<a+(y-b)/(d-
b)*(c-a))inside=!inside});return inside}function distanceTo(point,shape,points){if(shape==="point")return size(minus(point,points[0]));if(shape==="segment")return fromSegment(
point,...points);if(shape==="line"){const along2=minus(points[1],points[0]);return Math.abs(cross(along2,minus(point,points[0])))/size(along2)}const corners=outlineOf(
shape,points);if(isInside(point,corners))return 0;return Math.min(...corners.map((corner,k)=>fromSegment(point,corner,corners[(k+1)%corners.length])))}var crosses=(a,b,c,d)=>{
const turn=(p,q,r)=>Math.sign(cross(minus(q,p),minus(r,p)));return turn(a,b,c)*turn(a,b,d)<0&&turn(c,d,a)*turn(c,d,b)<0};var edges=corners=>corners.map((corner,k)=>[
corner,corners[(k+1)%corners.length]]);function overlap2(one,other){if(isInside(one[0],other)||isInside(other[0],one))return true;return edges(one).some(([a,b])=>edges(
other).some(([c,d])=>crosses(a,b,c,d)))}function segmentFromPolygon([start,end],corners){if(isInside(start,corners)||edges(corners).some(([c,d])=>crosses(start,
end,c,d)))return 0;return Math.min(...edges(corners).map(([c,d])=>Math.min(fromSegment(start,c,d),fromSegment(end,c,d),fromSegment(c,start,end),fromSegment(d,start,
end))))}var ARROWS={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]};var LEAST_CORNERS=3;var CLOSED=new Set(["box","polygon"]);var GROUND={x:0,y:0,a:0};
function pathOf(shape,points,place,view){const seen2=outlineOf(shape,points).map(point=>act(place,point)).map(([x,y])=>[view.X(x),view.Y(y)]);if(shape==="point")
return`M${px(seen2[0][0]-7)} ${px(seen2[0][1])}h14m-7 -7v14`;if(shape==="line"){const[[a,b],[c,d]]=seen2,size2=Math.hypot(c-a,d-b)||1,far=view.width+view.height+
Math.hypot(a,b);const[u,v]=[far*(c-a)/size2,far*(d-b)/size2];return`M${px(a-u)} ${px(b-v)}L${px(c+u)} ${px(d+v)}`}return`M${seen2.map(point=>point.map(px).join(
" ")).join("L")}${CLOSED.has(shape)?"Z":""}`}function withCorner(shape,points,k,to){if(shape!=="box")return points.map((point,i)=>i===k?to:point);const opposite=boxCorners(
points)[(k+2)%4];return[[Math.min(to[0],opposite[0]),Math.min(to[1],opposite[1])],[Math.max(to[0],opposite[0]),Math.max(to[1],opposite[1])]]}var ShapeHandles=class{constructor(scene,{
what,set,remove,select,abandon,className=""}){this.scene=scene;this.what=what;this.set=set;this.remove=remove;this.select=select;this.abandon=abandon;this.title=
s("title");this.area=s("path",{class:"bs-shape-area",tabindex:0,role:"button"},this.title);this.line=s("path",{class:"bs-shape-line"});this.element=s("g",{class:`\
bs-shape ${className}`},this.line,this.area);this.middles=new Kept(s("g"),(key,k)=>this.makeMiddle(k),(element,k)=>this.showMiddle(element,k));this.corners=new Kept(
s("g"),(key,k)=>this.makeCorner(k),(element,k)=>this.showCorner(element,k));this.handles=s("g",{class:"bs-corners"},this.middles.group,this.corners.group);this.
dragWhole();this.area.addEventListener("focus",()=>this.select());this.area.addEventListener("keydown",event=>this.keys(event,(points,by)=>points.map(([x,y])=>[
stepped(x,by[0]),stepped(y,by[1])]),()=>this.remove()))}draw(){const{shape,points,place,name,selected,state,data}=this.now=this.what();const d=pathOf(shape,points,
place,this.scene.view);put(this.line,"d",d);put(this.area,"d",d);this.area.classList.toggle("bs-open",!CLOSED.has(shape));put(this.area,"aria-label",`${name}${state?
`, ${state} by the chosen linkage`:""}. Drag, or use the arrow keys; Delete removes it.`);put(this.area,"aria-pressed",Boolean(selected));say(this.title,name);for(const[
key2,value2]of Object.entries({...data,shape}))put(this.element,`data-${key2}`,value2);this.element.classList.toggle("bs-selected",Boolean(selected));this.element.
classList.toggle("bs-met",state==="met");this.element.classList.toggle("bs-broken",state==="broken");const[[key,value]]=Object.entries(data);put(this.handles,"d\
ata-handles",`${key} ${value}`.trim());if(!this.handles.parentNode)this.scene.layer("tool").append(this.handles);const count=selected?outlineOf(shape,points).length:
0,edges2=shape==="polygon"?count:0;this.corners.draw([...Array(count).keys()].map(k=>[k,k]));this.middles.draw([...Array(edges2).keys()].map(k=>[k,k]))}clear(){
this.element.remove();this.handles.remove()}at([x,y]){const[u,v]=act(this.now.place,[x,y]);return{cx:px(this.scene.view.X(u)),cy:px(this.scene.view.Y(v))}}point({
x,y}){return back(this.now.place,[x,y]).map(each=>this.scene.rounded(each))}dragWhole(){let gesture,from,before;this.scene.drag(this.area,{start:point=>{gesture=
Symbol("move a shape");from=back(this.now.place,[point.x,point.y]);before=this.now.points},move:point=>{const to=back(this.now.place,[point.x,point.y]),by=[to[0]-
from[0],to[1]-from[1]];this.set(before.map(([x,y])=>[this.scene.rounded(x+by[0]),this.scene.rounded(y+by[1])]),gesture)},cancel:()=>this.abandon(gesture),click:()=>this.
select()})}makeCorner(k){const circle=s("circle",{class:"bs-corner",r:6,tabindex:0,role:"button","data-corner":k+1});let gesture;this.scene.drag(circle,{start:()=>(gesture=
Symbol("move a corner"))&&true,move:point=>this.set(withCorner(this.now.shape,this.now.points,k,this.point(point)),gesture),cancel:()=>this.abandon(gesture)});circle.
addEventListener("keydown",event=>this.keys(event,(points,by)=>{const[x,y]=outlineOf(this.now.shape,points)[k];return withCorner(this.now.shape,points,k,[stepped(
x,by[0]),stepped(y,by[1])])},()=>this.removeCorner(k)));return circle}removeCorner(k){const{shape,points}=this.now;if(shape!=="polygon"||points.length<=LEAST_CORNERS)
return;this.set(points.filter((_,i)=>i!==k),null)}makeMiddle(k){const circle=s("circle",{class:"bs-middle",r:4.5,"data-edge":k+1});let gesture;this.scene.drag(circle,
{start:()=>{gesture=Symbol("add a corner");this.set([...this.now.points.slice(0,k+1),this.now.points[k],...this.now.points.slice(k+1)],gesture)},move:point=>this.
set(withCorner("polygon",this.now.points,k+1,this.point(point)),gesture),cancel:()=>this.abandon(gesture)});return circle}showCorner(element,k){const corner=outlineOf(
this.now.shape,this.now.points)[k];for(const[name,value]of Object.entries(this.at(corner)))put(element,name,value);put(element,"aria-label",`Corner ${k+1} of ${this.
now.name}: ${corner.join(", ")}`)}showMiddle(element,k){const{points}=this.now,next=points[(k+1)%points.length];const middle2=this.at([(points[k][0]+next[0])/2,
(points[k][1]+next[1])/2]);for(const[name,value]of Object.entries(middle2))put(element,name,value)}keys(event,moved,remove){if(event.ctrlKey||event.metaKey)return;
const arrow2=ARROWS[event.key];if(arrow2){if(!event.repeat)this.keyed=Symbol("keys");const by=stepOf(event,this.scene.step);this.set(moved(this.now.points,[by*arrow2[0],
by*arrow2[1]]),this.keyed)}else if(event.key==="Delete"||event.key==="Backspace"){remove()}else{return}event.preventDefault();event.stopPropagation()}};var CLOSE=12;var PAIRS=new Set(["segment","line","box"]);var HINTS={point:"Click the point. Enter puts it in the middle, Escape gives up.",segment:"Click both e\
nds. Enter puts one in the middle, Escape gives up.",line:"Click two points of the line. Enter puts one in the middle, Escape gives up.",box:"Drag from corner t\
o corner, or click both. Enter puts one in the middle, Escape gives up.",polygon:"Click the corners; Enter or a click on the first one closes. Backspace takes t\
he last one back, Escape gives up."};var MIDDLE={point:[[0,0]],segment:[[-1,0],[1,0]],line:[[-1,0],[1,0]],box:[[-1,-1],[1,1]],polygon:[[-1,-1],[1,-1],[0,1]]};var SHARE2=.12;
var ordered=([[a,b],[c,d]])=>[[Math.min(a,c),Math.min(b,d)],[Math.max(a,c),Math.max(b,d)]];var isFlat=([[a,b],[c,d]])=>a===c&&b===d;var ShapeTool=class{constructor(scene,{
shape,place,done,name}){this.scene=scene;this.shape=shape;this.place=place;this.done=done;this.name=name;this.points=[];this.next=null;this.hint=HINTS[shape];this.
path=s("path",{class:"bs-draft"});this.dots=s("g");this.element=s("g",{},this.path,this.dots);scene.layer("tool").append(this.element)}point({x,y}){return back(
this.place(),[x,y]).map(each=>this.scene.rounded(each))}click(point,event){const next=this.point(point);if(this.shape==="polygon"){if(this.points.length>2&&(this.
isFirst(point)||event?.detail>1))return this.finish(this.points);if(this.points.length&&isFlat([this.points.at(-1),next]))return void 0}this.points.push(next);if(this.
shape==="point"||PAIRS.has(this.shape)&&this.points.length===2)return this.finish(this.points);return this.draw()}isFirst({X,Y}){const[x,y]=act(this.place(),this.
points[0]),{view}=this.scene;return Math.hypot(view.X(x)-X,view.Y(y)-Y)<CLOSE}hover(point){this.next=point&&this.point(point);this.draw()}drag(point,held){if(!PAIRS.
has(this.shape)||this.points.length)return false;this.dragging=[this.point(this.inPlane(held.from)),this.point(point)];this.draw();return true}inPlane({X,Y}){return{
x:this.scene.view.x(X),y:this.scene.view.y(Y)}}inMiddle(){const{width,height}=this.scene.size,half=SHARE2*Math.min(width,height);return MIDDLE[this.shape].map(([
x,y])=>this.point(this.inPlane({X:width/2+half*x,Y:height/2-half*y})))}release(){if(!this.dragging)return;const pair=this.dragging;this.dragging=null;this.finish(
pair)}finish(points){if(PAIRS.has(this.shape)&&isFlat(points)){this.points=points.slice(0,1);return this.draw()}this.scene.use(null);return this.done(this.shape===
"box"?ordered(points):points)}key(event){if(event.key==="Escape")this.scene.use(null);else if(event.key==="Backspace")this.points.pop();else if(event.key==="Ent\
er"&&!this.points.length)this.finish(this.inMiddle());else if(event.key==="Enter"&&this.points.length>2)this.finish(this.points);else return false;this.draw();return true}draw(){
const{scene:{view},shape}=this,shown2=this.dragging??[...this.points,...this.next?[this.next]:[]];const place=this.place(),whole=shape==="polygon"?"open polygon":
shape;const complete=shown2.length>1||shape==="point";put(this.path,"d",complete&&shown2.length?pathOf(whole,shown2,place,view):"");this.dots.replaceChildren(...(this.
dragging??this.points).map(point=>act(place,point)).map(([x,y],k)=>s("circle",{class:k?"bs-draft-dot":"bs-draft-dot bs-first",r:4,cx:px(view.X(x)),cy:px(view.Y(
y))})))}end(){this.element.remove()}};var PALEST=.4;function referenceIndex(store){const{selection,document:document2}=store;if(selection?.kind==="pose"&&selection.index<document2.poses.length)store.
reference=selection.index;return Math.min(store.reference??0,document2.poses.length-1)}function referencePlace(store){const k=referenceIndex(store);if(k<0)return{
x:0,y:0,a:0};const{x,y,angle}=standing(store.document,k);return{x,y,a:radians(angle)}}var BodyEditor=class{constructor(store,scene){this.store=store;this.scene=
scene;this.ghosts=new Kept(s("g",{class:"bs-ghosts","aria-hidden":"true"}),()=>s("path",{class:"bs-ghost"}),(path,item)=>this.showGhost(path,item));scene.layer(
"ghosts").append(this.ghosts.group);this.handles=new ShapeHandles(scene,{className:"bs-body-shape",what:()=>({shape:"polygon",points:bodyOf(store.document),place:referencePlace(
store),name:"Outline of the body",selected:store.selection?.kind==="body",data:{body:""}}),set:(points,gesture)=>store.edit(document2=>setBody(document2,points),
{gesture}),remove:()=>store.edit(document2=>setBody(document2,[])),select:()=>store.select({kind:"body",index:0}),abandon:gesture=>store.abandon(gesture)});store.
on("document selection",()=>this.draw());scene.on("view",()=>this.draw());this.draw()}indices(){const{document:{poses},selection}=this.store,chosen=selection?.kind===
"pose"?selection.index:null;return poses.map((_,k)=>k).filter(k=>hasGhost(k,poses.length)||k===chosen)}draw(){const body=bodyOf(this.store.document),{scale}=this.
scene.view;this.path=body.length?`M${body.map(([x,y])=>`${px(scale*x)} ${px(-scale*y)}`).join("L")}Z`:"";this.ghosts.draw(body.length?this.indices().map(k=>[k,k]):
[]);if(!body.length||!this.store.document.poses.length)return this.handles.clear();if(!this.handles.element.parentNode)this.scene.layer("ghosts").append(this.handles.
element);return this.handles.draw()}showGhost(path,k){const{view}=this.scene,{x,y,angle}=standing(this.store.document,k),last=Math.max(1,this.store.document.poses.
length-1);if(!isOther(path,[view,x,y,angle,k/last,this.path]))return;put(path,"d",this.path);put(path,"opacity",(PALEST+(1-PALEST)*k/last).toFixed(3));put(path,
"transform",transform(view.X(x),view.Y(y),radians(angle)))}tool(){return new ShapeTool(this.scene,{shape:"polygon",name:"body",place:()=>referencePlace(this.store),
done:points=>{this.store.edit(document2=>setBody(document2,points));this.store.select({kind:"body",index:0})}})}};var TYPED_IN="button, input, select, textarea, summary, a, [role=button], [role=slider]";var written2=element=>element?.matches?.("input:not([type=checkbox]):no\
t([type=radio]):not([type=range]), textarea");function listenToKeys(store,scene,files=null,root=document){const acts=event=>({z:()=>event.shiftKey?store.redo():
store.undo(),y:()=>store.redo(),...files&&{s:()=>files.save(),o:()=>files.chooser.click()}});root.addEventListener("keydown",event=>{const{key,target}=event,control=(event.
ctrlKey||event.metaKey)&&!event.altKey;if(control){const act2=acts(event)[key.toLowerCase()];if(!act2||written2(target)&&target.dataset.typing==="true"&&/^[zy]$/i.
test(key))return;event.preventDefault();act2()}else if(scene.dragged&&key==="Escape"){event.preventDefault();scene.dragged.cancel()}else if(scene.tool&&!written2(
target)&&scene.tool.key(event)){event.preventDefault();event.stopPropagation()}else if(key==="Escape"&&!written2(target)&&store.selection){store.select(null)}},
true);root.addEventListener("input",({target})=>target instanceof HTMLElement&&(target.dataset.typing="true"));for(const name of["change","focusout"])root.addEventListener(
name,({target})=>target instanceof HTMLElement&&delete target.dataset.typing)}function listenToSpace({player},root=document){root.addEventListener("keydown",event=>{
if(event.key!==" "||event.ctrlKey||event.metaKey||event.altKey||event.target instanceof Element&&event.target.closest(TYPED_IN)||!player.path)return;event.preventDefault();
player.play(!player.playing)})}var BODY_AXIS=AXIS+10;var LETTER2=14;var TURNING_ARROW="M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9";var BLOCK_IN_SLOT=[18,10];var SPARE2=5;var NAME=15;
var ARROW=24;var Mechanism=class{constructor({led,drawn:links=[],ground,names}){this.kinds=kindsOf(led);this.outline=s("path",{class:"bm-body-outline"});this.links=s("g");this.
blocks=s("g");this.pins=s("g");this.coupler=s("g",{class:"bm-coupler"});this.arrow=s("path",{class:"bm-drive-mark bm-side0"});this.letter=s("text",{class:"bm-le\
tter","text-anchor":"middle"},"M");this.plates=[s("path",{class:"bm-plate-rim"}),s("path",{class:"bm-plate"})];this.coupler.append(...this.plates);this.parts=led.
map((dyad,side)=>new PARTS[dyad.kind](this,side));if(links.length)this.parts.push(...links.map(link=>new JointedLink(this,link)),new Joints(this,ground,names));
this.coupler.append(s("path",{class:"bm-body-frame",d:axes(BODY_AXIS)}),s("circle",{class:"bm-origin",r:4}));for(const part of this.parts)if(part.pin)this.coupler.
append(part.pin);this.marks=new LoadMarks;this.group=s("g",{class:"bm-linkage"},this.arrow,this.links,this.coupler,this.blocks,this.pins,this.marks.group,links.
length?null:this.letter)}fits({led}){return kindsOf(led)===this.kinds}shape(data,linkage,view,places){this.view=view;this.led=linkage.led;this.hasBody=Boolean(data.
body);if(this.hasBody){put(this.outline,"d",bodyOutline(data,view));if(!this.outline.parentNode)this.group.prepend(this.outline)}else{this.outline.remove()}const corners=[
[0,0]];linkage.led.forEach((dyad,side)=>{if(dyad.moving_pivot)corners.push(inBody(dyad.moving_pivot,view));const more=this.parts[side].shape(dyad,view,places);if(more)
corners.push(more)});const d=`M${hull(corners).map(corner=>corner.map(px).join(" ")).join("L")}Z`;for(const plate of linkage.drawn?[]:this.plates)put(plate,"d",
d);for(const part of this.parts.slice(linkage.led.length))part.shape(view);this.marks.shape(data,linkage,view);this.shapeArrow()}show(place,drive=null){const{view}=this,
at=transform(view.X(place.x),view.Y(place.y),place.a);this.marks.show(place,drive);put(this.coupler,"transform",at);if(this.hasBody)put(this.outline,"transform",
at);for(const part of this.parts)part.show(place);const[x,y]=act(place,[LETTER2/view.scale,-LETTER2/view.scale]);put(this.letter,"transform",`translate(${px(view.
X(x))} ${px(view.Y(y)+4)})`);const[driver]=this.led;if(driver.kind==="PR")put(this.arrow,"transform",`${onRail(driver,place,view)} translate(0 ${-ARROW})`)}shapeArrow(){
const{arrow:arrow2,view}=this,[driver]=this.led;if(driver.kind==="PR")put(arrow2,"d","M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5");if(!driver.fixed_pivot)return;const[
x,y]=driver.fixed_pivot;put(arrow2,"d",TURNING_ARROW);put(arrow2,"transform",`translate(${px(view.X(x))} ${px(view.Y(y))}) rotate(-90)`)}};var kindsOf=led=>led.
map(dyad=>dyad.kind).join();var inBody=([x,y],view)=>[view.scale*x,-view.scale*y];function onRail(dyad,place,view){const[x,y]=act(place,dyad.moving_pivot),[nx,ny]=normalOf(
dyad);return transform(view.X(x),view.Y(y),Math.atan2(nx,-ny))}var block=(side,width,height)=>s("g",{class:`bm-block bm-side${side}`},s("rect",{x:-width/2,y:-height/
2,width,height,rx:2}));function setPin(pin,[x,y],dyad){put(pin,"cx",px(x));put(pin,"cy",px(y));put(pin,"data-dyad",dyad.id)}var inGround=([x,y],view)=>[view.X(x),
view.Y(y)];var Bar=class{constructor({links,pins},side){this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"bm-core"})];this.bar=s("g",{class:`bm-link bm-\
side${side}`},this.strokes);this.ground=s("circle",{class:"bm-pin bm-fixed-pin",r:4.5});this.pin=s("circle",{class:"bm-pin",r:4.5});links.append(this.bar);pins.
append(this.ground)}shape(dyad,view){this.dyad=dyad;this.view=view;for(const stroke of this.strokes)put(stroke,"d",`M0 0H${px(view.scale*dyad.radius)}`);setPin(
this.ground,inGround(dyad.fixed_pivot,view),dyad);setPin(this.pin,inBody(dyad.moving_pivot,view),dyad)}show(place){const{dyad,view}=this,[cx,cy]=dyad.fixed_pivot,
[x,y]=act(place,dyad.moving_pivot);put(this.bar,"transform",transform(view.X(cx),view.Y(cy),Math.atan2(y-cy,x-cx)))}};var BlockOnRail=class{constructor({blocks},side){
this.block=block(side,...BLOCK);this.pin=s("circle",{class:"bm-pin",r:4.5});blocks.append(this.block)}shape(dyad,view){this.dyad=dyad;this.view=view;put(this.block,
"data-dyad",dyad.id);setPin(this.pin,inBody(dyad.moving_pivot,view),dyad)}show(place){put(this.block,"transform",onRail(this.dyad,place,this.view))}};var Slot=class{constructor({
blocks,pins,coupler},side){this.strokes=["rim","plate","edge"].map(name=>s("path",{class:`bm-slot-${name}`}));this.strokes.push(s("path",{class:"bm-slot"}));this.
block=block(side,...BLOCK_IN_SLOT);this.ground=s("circle",{class:"bm-pin bm-fixed-pin",r:4});coupler.append(...this.strokes);blocks.append(this.block);pins.append(
this.ground)}shape(dyad,view,places){this.dyad=dyad;this.view=view;const[low,high]=places.length?travelOf(dyad,places):[0,0],end=(BLOCK_IN_SLOT[0]/2+SPARE2)/view.
scale;const seen2=along2=>inBody(pointOnLine(dyad,along2),view);const d=`M${[seen2(low-end),seen2(high+end)].map(each=>each.map(px).join(" ")).join("L")}`;for(const stroke of this.
strokes)put(stroke,"d",d);for(const part of[this.strokes[3],this.block])put(part,"data-dyad",dyad.id);setPin(this.ground,inGround(dyad.fixed_pivot,view),dyad);return seen2(
(low+high)/2)}show(place){const{dyad,view}=this,[nx,ny]=normalOf(dyad),[cx,cy]=dyad.fixed_pivot;put(this.block,"transform",transform(view.X(cx),view.Y(cy),place.
a+Math.atan2(nx,-ny)))}};var JointedLink=class{constructor({links},{joints,kind}){this.joints=[...joints];this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"\
bm-core"})];links.append(s("g",{class:`bm-link bm-${kind}${joints.length>2?" bm-ternary":""}`,"data-link":joints.replace("M","")},this.strokes))}shape(view){this.
view=view}show(place){const d=`M${this.joints.map(joint=>inGround(place.joints[joint]??[place.x,place.y],this.view).map(px).join(" ")).join("L")}${this.joints.length>
2?"Z":""}`;for(const stroke of this.strokes)put(stroke,"d",d)}};var Joints=class{constructor({pins},ground,names){this.pins=[...Object.keys(ground),...Object.keys(
names)].map(joint=>{const pin=s("circle",{class:`bm-pin${joint in ground?" bm-fixed-pin":""}`,r:4.5,"data-joint":joint});return{joint,pin,link:[...names[joint]??
""],name:joint in ground?null:s("text",{class:"bm-name","text-anchor":"middle"},joint)}});pins.append(...this.pins.map(({pin})=>pin),...this.pins.flatMap(({name})=>name??
[]))}shape(view){this.view=view}show({joints}){for(const{joint,pin,link,name}of this.pins){const[x,y]=inGround(joints[joint],this.view);put(pin,"cx",px(x));put(
pin,"cy",px(y));if(!name)continue;const[u,v]=outwards(link.map(each=>inGround(joints[each],this.view)),[x,y]);put(name,"x",px(x+NAME*u));put(name,"y",px(y+NAME*
v+4))}}};function outwards(corners,[x,y]){const middle2=[0,1].map(k=>corners.reduce((sum,corner)=>sum+corner[k],0)/corners.length);const u=x-middle2[0],v=y-middle2[1],
size2=Math.hypot(u,v);return size2>1?[u/size2,v/size2]:[0,-1]}var Nothing=class{shape(){}show(){}};var PARTS={RR:Bar,PR:BlockOnRail,RP:Slot,PP:Nothing,crank:Nothing};var LONGEST=4e3;function railOf(dyad,places,view){const[nx,ny]=normalOf(dyad),[low,high]=travelOf(dyad,places);const half=view.scale*(high-low)/2+BLOCK[0],edge=BLOCK[1]/
2+1;const[x,y]=(at=>[view.X(at[0]),view.Y(at[1])])(pointOnLine(dyad,(low+high)/2));const bodySide=places.reduce((sum,place)=>sum+nx*place.x+ny*place.y-dyad.line.
offset,0);const turned=Math.atan2(nx,-ny)+(bodySide>0?Math.PI:0);const drawn=Math.min(half,LONGEST);let hatch="";for(let k=-drawn+4;k<drawn-2;k+=8)hatch+=`M${px(
k+4)} ${edge}l-6 7`;return{x,y,half,drawn,turned,paths:[`M${px(-half)} ${edge}H${px(half)}${hatch}`,`M${px(-half)} ${-edge}H${px(half)}`]}}var FACTORS=[0,1,10,100,1e3,1e4,1e5];function factorFor(data,linkage){const worst=Math.max(0,...linkage.pose_errors.map(row=>row.position??0));if(!(worst>1e-9*data.
scene))return 0;const fits=FACTORS.filter(factor=>factor>=1&&factor*worst<.3*data.scene);return fits.length?fits[fits.length-1]:1}var scaleOfErrors=({width},factor)=>s("text",{class:"bm-error-scale",x:width-8,y:16,"text-anchor":"end"},factor===1?"errors to scale":`errors × ${factor.toLocaleString(
"en").replaceAll(","," ")}`);var hundredths=value=>Math.round(Math.min(Math.max(value,-1e6),1e6)*100)/100;function smoothPath(X,Y,closed2){const last=X.length-1;if(last<1)return"";const ahead=(values,k)=>k<
last?values[k+1]:closed2?values[1]:2*values[last]-values[last-1];const behind=(values,k)=>k>0?values[k-1]:closed2?values[last-1]:2*values[0]-values[1];let d=`M${hundredths(
X[0])} ${hundredths(Y[0])}`;let[u,v]=[(ahead(X,0)-behind(X,0))/6,(ahead(Y,0)-behind(Y,0))/6];for(let k=0;k<last;k+=1){const p=(ahead(X,k+1)-X[k])/6,q=(ahead(Y,k+
1)-Y[k])/6;d+=`C${hundredths(X[k]+u)} ${hundredths(Y[k]+v)} ${hundredths(X[k+1]-p)} ${hundredths(Y[k+1]-q)} ${hundredths(X[k+1])} ${hundredths(Y[k+1])}`;[u,v]=[
p,q]}return d}var MOST_ACHIEVED=240;var OFF=27;var FOOT=11;var LEAST_ARROW2=1.5;var LiveLinkage=class{constructor(answers,playing,scene){this.answers=answers;this.playing=playing;
this.scene=scene;this.factor=0;this.beyond=s("path",{class:"bm-curve bm-beyond"});this.others=s("path",{class:"bm-curve bm-other"});this.here=s("path",{class:"b\
m-curve bm-here"});this.pivotPaths=[0,1].map(side=>s("path",{class:`bm-pivot-path bm-side${side}`}));this.paths=s("g",{class:"bs-paths","aria-hidden":"true"},this.
others,this.beyond,...this.pivotPaths,this.here);this.feet=[0,1].map(side=>{const at=foot();at.classList.add(`bm-side${side}`);return at});this.rails=[0,1].map(
side=>s("g",{class:`bm-rail bm-side${side}`},s("path",{class:"bm-ground"}),s("path",{class:"bm-ground bm-thin"})));this.achieved=s("g",{class:"bs-achieved"});this.
arrows=s("path",{});this.names=[0,1].map(side=>s("text",{class:`bm-name bm-side${side}`,"text-anchor":"middle"}));this.mechanism=null;this.holder=s("g",{class:"\
bs-mechanism"},...this.rails,...this.feet,this.achieved,s("g",{class:"bm-errors"},this.arrows));this.labels=s("g",{class:"bs-dyad-names"},this.names);this.edges=
s("g",{class:"bs-edges"});scene.layer("paths").append(this.paths);scene.layer("mechanism").append(this.holder);scene.layer("labels").append(this.labels,this.edges);
scene.hold?.(()=>this.points());scene.on("closer",()=>this.closer());answers.on("shown",()=>scene.isFitted&&scene.fit(scene.isWhole));playing.on("shape",()=>this.
shape());playing.on("place",({place,drive})=>this.mechanism?.show(place,drive));scene.on("view",()=>this.redraw());scene.names?.avoid(()=>this.obstacles());this.
redraw()}points(close=false){const{linkage}=this.playing,{data}=this.answers;return nearPoints(data,linkage,linkage?placesAtPoses(data,linkage):[],{close})}closer(){
const{selection,document:{poses}}=this.answers.store,k=selection?.kind==="pose"?selection.index:null;const near2=k===null?[]:poses.slice(Math.max(0,k-1),k+2).map(
pose=>[pose.x??0,pose.y??0]);this.scene.closeUp(near2.length>1?near2:this.points(true))}obstacles(){const{playing:{linkage},scene:{view}}=this,pins=linkage&&!linkage.
gone?linkage.led.filter(dyad=>dyad.fixed_pivot):[];return pins.map(({fixed_pivot:[x,y]})=>[view.X(x),view.Y(y)+FOOT,34,36])}enlarge(){const{linkage}=this.playing,
{data}=this.answers;const seen2=linkage?.pose_errors.length&&!(linkage.followed&&linkage.worst<UNSEEN*data.scene);const fits=seen2?factorFor(data,linkage):0;this.
factor=this.answers.isOld&&this.factor&&fits?Math.min(this.factor,fits):fits}redraw(){this.shape();if(this.playing.here&&this.playing.path)this.mechanism?.show(
this.playing.here.place,this.playing.here.drive)}shape(){const{playing,answers,scene}=this,{linkage,path}=playing,{view}=scene;const there=Boolean(linkage)&&!linkage.
gone;for(const part of[this.paths,this.holder,this.labels,this.edges])put(part,"visibility",there?"visible":"hidden");if(!there)return;const places=path?framesOf(
path):[];this.enlarge();this.curves(linkage,path,places,view);this.ground(linkage,places,view);this.outside(linkage,view);this.atPoses(linkage,view);if(!path){this.
mechanism?.group.remove();this.mechanism=null;return}if(!this.mechanism?.fits(linkage)){this.mechanism?.group.remove();this.mechanism=new Mechanism(linkage);this.
holder.append(this.mechanism.group)}this.mechanism.shape(answers.data,linkage,view,places)}curves(linkage,path,places,view){const set=(element,list2,closed2)=>put(
element,"d",smoothPath(list2.map(([x])=>view.X(x)),list2.map(([,y])=>view.Y(y)),closed2));const others=linkage.ways.filter(way=>way!==path);put(this.others,"d",
others.map(way=>pathOf2(way,view)).join(""));put(this.beyond,"d",path?pathOf2(path,view):"");this.pivotPaths.forEach((element,side)=>{const dyad=linkage.led[side];
if(!path||!dyad.moving_pivot||dyad.kind==="PR")put(element,"d","");else set(element,places.map(place=>act(place,dyad.moving_pivot)),path.round)});if(!path){put(
this.here,"d","");return}const{low,high}=this.playing.player.stretch,{length}=this.answers.data.chart,list=[];const end=u=>(place=>[place.x,place.y])(placeAt(linkage,
path,u,length));list.push(end(low));for(let k=Math.floor(low)+1;k<high;k+=1)list.push([path.x[k],path.y[k]]);list.push(end(high));set(this.here,list,path.round&&
high-low>path.x.length-1-1e-6)}ground(linkage,places,view){const{scene}=this;linkage.led.forEach((dyad,side)=>{const[rail,at,name]=[this.rails[side],this.feet[side],
this.names[side]];const slides=dyad.kind==="PR"&&places.length>0;put(rail,"display",slides?"inline":"none");put(at,"display",dyad.fixed_pivot?"inline":"none");put(
name,"display",slides||dyad.fixed_pivot?"inline":"none");say(name,dyad.id);let x,y;if(slides){const drawn=railOf(dyad,places,view);({x,y}=drawn);put(rail,"trans\
form",transform(x,y,drawn.turned));drawn.paths.forEach((d,k)=>put(rail.children[k],"d",d));put(rail,"data-dyad",dyad.id)}else if(dyad.fixed_pivot){[x,y]=[view.X(
dyad.fixed_pivot[0]),view.Y(dyad.fixed_pivot[1])];put(at,"transform",`translate(${px(x)} ${px(y)})`)}else{return}scene.names.put(name,x,y+FOOT,dyad.id,around(dyad.
id,-Math.PI/2,OFF))})}outside(linkage,view){const marks=linkage.led.flatMap((dyad,side)=>{const edge=dyad.fixed_pivot&&edgeTowards(view,dyad.fixed_pivot),end=edge&&
edge.x>view.width/2;return edge?[s("g",{class:`bm-to-far bm-side${side}`,"data-dyad":dyad.id,onclick:()=>this.scene.reveal(dyad.fixed_pivot)},s("path",{class:`b\
m-far-mark bm-side${side}`,d:"M-9 -6L3 0L-9 6",transform:transform(edge.x,edge.y,edge.angle)}),s("text",{class:`bm-name bm-side${side}`,x:px(edge.x+(end?-12:12)),
y:px(clamp(edge.y+4,14,view.height-24)),"text-anchor":end?"end":"start"},`${dyad.id} is outside`))]:[]});this.edges.replaceChildren(...marks,...this.factor?[scaleOfErrors(
view,this.factor)]:[])}atPoses(linkage,view){const{achieved,answers:{data}}=this,rows=linkage.pose_errors;const count=Math.min(rows.length,MOST_ACHIEVED),small=count>
24?.6:1;while(achieved.children.length>count)achieved.lastChild.remove();while(achieved.children.length<count)achieved.append(s("g",{class:"bm-achieved"},s("pat\
h",{}),s("circle",{})));let arrows="";for(let k=0;k<count;k+=1){const row=rows[k],group=achieved.children[k];if(group.dataset.size!==String(small)){group.dataset.
size=small;put(group.children[0],"d",axes(.72*AXIS*small));put(group.children[1],"r",2.2*small)}if(row.x===null){put(group,"display","none");continue}put(group,
"display","inline");put(group.children[0],"display",data.poses[k]?.angle_deg===null?"none":"inline");put(group,"transform",transform(view.X(row.x),view.Y(row.y),
radians(row.angle_deg)));group.classList.toggle("bm-elsewhere",row.at!==this.playing.path);if(this.factor&&data.poses[k])arrows+=arrow(view,data.poses[k],row,this.
factor)}put(this.arrows,"d",arrows)}};var framesOf=way=>Array.from(way.x,(x,k)=>({x,y:way.y[k],a:way.angle[k]}));var pathOf2=(way,view)=>smoothPath(Array.from(way.
x,view.X),Array.from(way.y,view.Y),way.round);function arrow(view,pose,row,factor){const x=view.X(pose.x),y=view.Y(pose.y),by=factor*view.scale;const dx=by*(row.
x-pose.x),dy=-by*(row.y-pose.y),size2=Math.hypot(dx,dy);if(!(size2>=LEAST_ARROW2))return"";const head=Math.min(7,.5*size2),ux=dx/size2,uy=dy/size2,tip=`${px(x+dx)}\
 ${px(y+dy)}`;const barb=sign=>`L${px(x+dx-head*(ux-sign*.5*uy))} ${px(y+dy-head*(uy+sign*.5*ux))}`;return`M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}`}function wayStory(way,poses){const noun=nounOf({poses}),names=poses.map(pose=>pose.label);const all=way.poses.length===names.length;const here=all?`all ${noun}s`:
way.poses.length?`${noun}${way.poses.length>1?"s":""} ${runs(way.poses,names)}`:`no ${noun}`;const dead=way.dead.filter(Boolean).length;const ends=way.round?"tu\
rns round":dead===2?"between two dead points":dead?"up to a dead point":"open";return`${here}; ${ends}`}var Assemblies=class{constructor(data,take){this.data=data;this.take=take;this.name=`bm-way-${Math.random().toString(36).slice(2)}`;this.element=h("fieldset",{class:"\
bm-ways"})}build(linkage,index){const one=(way,k)=>h("label",{},h("input",{type:"radio",name:this.name,value:k,checked:k===index,onchange:()=>this.take(k)}),h("\
span",{},h("b",{},wayName(way,linkage).replace("assembly ","")),` ${wayStory(way,this.data.poses)}`));this.element.replaceChildren(h("legend",{},"Assembly"),...linkage.
ways.map(one));give(this.element,"hidden",!linkage.ways.length||Boolean(this.data.whole))}};var TURN_SECONDS=7;var TURN=1e-6;var NAME_ROWS=5;var NUMBER_ROWS=2;var MANY_POSES=100;var ROW=13;var LONGEST_TICK=18;var NO_ERROR=1e-7;var STEPS=360;var SPEEDS=[
.25,.5,1,2,4];var LOOPS=[["back","there and back"],["again","again and again"],["once","once"]];var Player=class{parts;steps;tick;wholeLabel;speeds;loops;real;realLabel;constructor(data,show,rebuild){
this.data=data;this.draw={show,rebuild};this.linkage=null;this.way=0;this.u=0;this.heading=1;this.speed=1;this.loop="back";this.isReal=false;this.whole=false;this.
stretch={low:0,high:1,sense:1};this.playing=false;this.remaining=null;this.element=this.controls()}get path(){return this.linkage?.ways[this.way]}get stop(){return nounOf(
this.data)}controls(){const button2=(name,text,label,onclick)=>h("button",{type:"button",class:`bm-button ${name}`,"aria-label":label,title:label,onclick},text);
this.button=button2("bm-play","","Play",()=>this.play(!this.playing));this.slider=h("input",{type:"range",class:"bm-slider",min:0,step:"any","aria-label":"Drive\
r",oninput:()=>this.go(this.turned(Number(this.slider.value)))});this.box=h("input",{type:"checkbox",onchange:()=>this.playWhole(this.box.checked)});this.boxName=
h("span",{},"Whole branch");this.stops=s("svg",{class:"bm-stops","aria-hidden":"true"});this.parts=["","","",""].map(text=>h("span",{},text));this.readout=h("ou\
tput",{class:"bm-now"},this.parts.flatMap((part,k)=>k?[" ",part]:[part]));this.slider.addEventListener("keydown",event=>{const step={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,
ArrowUp:1}[event.key];if(!step)return;event.preventDefault();this.step(event.shiftKey?10*step:step)});const choice=(label,entries,take)=>h("select",{class:"bm-p\
ick","aria-label":label,title:label,onchange:event=>take(event.target.value)},entries.map(([value,text])=>h("option",{value},text)));this.steps=[button2("bm-bac\
k","","",()=>this.toPose(-1)),button2("bm-next","","",()=>this.toPose(1))];this.speeds=choice("Speed",SPEEDS.map(each=>[each,`${each} ×`]),value=>this.speed=Number(
value));this.speeds.value="1";this.loops=choice("What comes after the last pose",LOOPS,value=>this.takeLoop(value));this.real=h("input",{type:"checkbox",onchange:()=>this.
isReal=this.real.checked});this.realLabel=h("label",{class:"bm-real",hidden:true,title:"Move as the drive of the task moves it"},this.real,h("span",{},"As drive\
n"));this.wholeLabel=h("label",{class:"bm-whole"},this.box,this.boxName);this.nameStops();return h("div",{class:"bm-controls"},h("div",{class:"bm-track"},this.slider,
this.stops),h("div",{class:"bm-row"},this.button,this.steps[0],button2("bm-small-step","‹","A small step back",()=>this.step(-1)),button2("bm-small-step","›",
"A small step on",()=>this.step(1)),this.steps[1],this.speeds,this.loops,this.wholeLabel,this.realLabel),this.readout)}nameStops(){const{stop}=this,title=stop[0].
toUpperCase()+stop.slice(1);[[`◀ ${title}`,`Previous ${stop}`],[`${title} ▶`,`Next ${stop}`]].forEach(([text,label],k)=>{say(this.steps[k],text);put(this.steps[k],
"aria-label",label);give(this.steps[k],"title",label)});give(this.wholeLabel,"title",`Play all that the driver reaches, not only from the first ${stop} to the l\
ast`)}load(linkage){this.linkage=linkage;const counts=linkage.ways.map(way=>way.poses.length);this.take(Math.max(0,counts.indexOf(Math.max(...counts))))}take(index){
this.way=index;this.u=this.firstStop();this.draw.rebuild()}get stopsOnWay(){return this.linkage.pose_errors.map((row,k)=>({...row,k})).filter(row=>row.way===this.
way)}firstStop(){return this.stopsOnWay[0]?.frame??0}rebuild(){const{path,slider}=this;if(!path)this.play(false);this.nameStops();for(const each of[slider,this.
button])give(each,"disabled",!path);if(this.linkage)this.stretch=stretchOf(this.linkage,this.way,this.whole);give(this.box,"disabled",!this.stretch.isApart);give(
this.realLabel,"hidden",!this.timed);say(this.boxName,path?.round?"Whole turn":"Whole branch");this.heading=1;this.u=clamp(this.u,this.stretch.low,this.stretch.
high)}playWhole(on){this.whole=on;this.draw.rebuild()}drawStops(){const{stops,path}=this,{low,high}=this.stretch;stops.replaceChildren();if(!path)return;const width=Math.
max(60,this.slider.clientWidth),inset=9;const X=u=>inset+(this.turned(u)-low)/(high-low)*(width-2*inset);const known=this.stopsOnWay.filter(row=>this.data.poses[row.
k]);const rows=known.sort((a,b)=>X(a.frame)-X(b.frame)).map(row=>({...row,x:X(row.frame),pose:this.data.poses[row.k]}));const named=laidOut(rows.map(({x,pose})=>({
x,text:shortened(poseName(pose),LONGEST_TICK)})),width,NAME_ROWS);const texts=named.every(({at})=>at>=0)?named:laidOut(rows.map(({x,pose})=>({x,text:pose.label})),
width,rows.length>MANY_POSES?1:NUMBER_ROWS);const deepest=Math.max(0,...texts.map(({at})=>at));const one=(k,pose,...parts)=>s("g",{"data-pose":k+1},s("title",{},
calledOf(pose)),...parts);rows.forEach(({k,x,pose},i)=>stops.append(one(k,pose,s("path",{d:`M${px(x)} 0V${4+ROW*Math.max(0,texts[i].at)}`}))));rows.forEach(({k,
pose},i)=>{const{at,middle:middle2,text}=texts[i];if(at>=0)stops.append(one(k,pose,s("text",{x:px(middle2),y:14+ROW*at,"text-anchor":"middle"},text)))});put(stops,
"viewBox",`0 0 ${width} ${16+ROW*deepest}`);put(stops,"height",16+ROW*deepest)}play(on){if(on&&!this.path)return;this.remaining=null;if(on===this.playing&&this.
isDressed)return;this.isDressed=true;this.playing=on;put(this.readout,"aria-live",on?"off":"polite");this.button.replaceChildren(icon(on),on?"Pause":"Play");put(
this.button,"aria-label",on?"Pause":"Play");this.button.title=on?"Pause (space)":"Play (space)";cancelAnimationFrame(this.tick);if(!on)return;let before=null;const run=now=>{
if(!this.playing)return;if(before!==null)this.advance(Math.min(.1,(now-before)/1e3));before=now;if(this.playing)this.tick=requestAnimationFrame(run)};this.tick=
requestAnimationFrame(run)}playOnce(){if(!this.path)return;const{low,high}=this.stretch;this.u=this.turned(low);this.heading=1;this.play(true);this.remaining=(this.
goesRound?1:2)*(high-low)}get goesRound(){return this.path.round&&this.stretch.high-this.stretch.low>this.path.x.length-1-TURN}turned(u){const{low,high,sense}=this.
stretch;return sense<0?low+high-u:u}get timed(){const loads=this.linkage?.followed?null:this.linkage?.loads;return loads?.way===this.way&&!this.whole?loads.timed:
null}takeLoop(loop){this.loop=loop;this.heading=1}advance(seconds){const{low,high}=this.stretch;if(this.isReal&&this.timed)return this.drive(seconds);const step=this.
speed*seconds*(high-low)/(this.goesRound?TURN_SECONDS:TURN_SECONDS/2);if(this.remaining!==null){this.remaining-=step;if(this.remaining<=0){this.play(false);this.
u=this.firstStop();this.show();return}}const at=this.turned(this.u)+this.heading*step,isOver=at>=high;if(isOver&&this.loop==="once"){this.play(false);this.u=this.
turned(high)}else if(this.goesRound){this.u=this.turned(around2(at,high))}else if(isOver&&this.loop==="again"){this.u=this.turned(low)}else{if(isOver||at<=low)this.
heading=isOver?-1:1;this.u=this.turned(clamp(at,low,high))}this.show()}drive(seconds){const{timed}=this,{y}=timed.time,last=Math.max(y[0],y[y.length-1]),here=valueAt(
timed.time,linear(this.path.drive,this.u))??0;let time=here+this.speed*seconds;if(time>=last&&here<last)time=last;else if(time>=last&&this.loop==="once")return this.
play(false);else if(time>=last)time=0;this.u=frameAt(this.path.drive,driveAtTime(timed,time)??linear(this.path.drive,this.u)??0);this.show()}step(steps){if(!this.
path)return;const{low,high}=this.stretch;const at=this.turned(this.u)+steps*Math.max(.001,(high-low)/STEPS);this.go(this.turned(this.goesRound?around2(at,high):
at))}go(u){if(!this.path)return;this.play(false);this.u=clamp(u,this.stretch.low,this.stretch.high);this.show()}toPose(sense){const all=this.linkage.pose_errors.
map((row,k)=>({...row,k})).filter(row=>row.way!==null);if(!all.length)return;const here=this.atPose??(sense>0?-1:this.data.poses.length);const next=sense>0?all.
find(row=>row.k>here)??all[0]:[...all].reverse().find(row=>row.k<here)??all[all.length-1];this.play(false);if(next.way!==this.way){this.way=next.way;this.u=next.
frame;this.draw.rebuild()}this.go(next.frame);this.atPose=next.k}placeAt(u){return placeAt(this.linkage,this.path,u,this.data.chart.length)}nearest(place){let near2=0,
least2=Infinity;this.data.poses.forEach((pose,k)=>{const turn=pose.angle_deg===null?0:place.a-radians(pose.angle_deg);const away=Math.hypot(place.x-pose.x,place.
y-pose.y,this.data.chart.length*(turn-2*Math.PI*Math.round(turn/(2*Math.PI))));if(away<least2)[near2,least2]=[k,away]});return near2}show(told=true){const{path}=this;
if(!path){for(const part of this.parts)part.textContent="";return}const place=this.placeAt(this.u);const drive=linear(path.drive,this.u),transmission=linear(path.
transmission,this.u);const near2=this.atPose=this.nearest(place);if(told){give(this.slider,"min",this.stretch.low);give(this.slider,"max",this.stretch.high);give(
this.slider,"value",this.turned(this.u));this.tell(place,drive,transmission,near2)}this.draw.show(place,drive,transmission,near2)}driverText(drive){const{data,linkage}=this;
return linkage.led[0].kind==="PR"?`${fixed(drive,decimalsOf(data))}${data.unit?` ${data.unit}`:""}`:`${linkage.crank??""}${fixed(drive,1)}°`}tell(place,drive,transmission,near2){
const{data,linkage}=this;const unit=data.unit?` ${data.unit}`:"",digits=decimalsOf(data),driver=this.driverText(drive);const pose=data.poses[near2],row=linkage.
pose_errors[near2];const at=row?.at===this.path&&Math.abs(row.frame-this.u)<1e-6;const away=()=>`${figure(Math.hypot(place.x-pose.x,place.y-pose.y))}${unit} fro\
m ${calledOf(pose)}`;const missed2=()=>`at ${calledOf(pose)}, ${row.said.position==="exact"?"":"off by "}${missOf(row.said.position,row.said.turned,unit)}`;const said=!pose?
"between the poses":pose.called?`${at?"at":"near"} ${pose.called}`:at?missed2():away();const time=this.isReal&&this.timed&&drive!==null?valueAt(this.timed.time,
drive):null;const known=this.path.told?.map(each=>this.toldOf(each))??[`driver ${driver}${time===null?"":` at ${fixed(time,2)} s`}`,`body (${fixed(place.x,digits)}\
, ${fixed(place.y,digits)})${unit}, ${fixed(((degrees(place.a)+180)%360+360)%360-180,2)}°`];const texts=[...known,`transmission ${transmission===null?"–":`${fixed(
transmission,1)}°`}`,said];texts.forEach((text,k)=>{const whole=k+1<texts.length?`${text} ·`:text;if(this.parts[k].textContent!==whole)this.parts[k].textContent=
whole});put(this.slider,"aria-valuetext",`${texts[0]}, ${texts[3]}`)}toldOf({name,digits,values,panel}){const error=panel===void 0?null:valueAt(this.linkage.panels[panel],
smooth(this.path.drive,this.u));const off=error===null?"":`, off by ${Math.abs(error)<NO_ERROR?"0":figure(error)}°`;return`${name} ${fixed(smooth(values,this.u),
digits)}°${off}`}};function laidOut(texts,width,count){const ends=Array(count).fill(-99);return texts.map(({x,text})=>{const size2=6.4*text.length,left=clamp(x-
size2/2,0,Math.max(0,width-size2));const at=ends.findIndex(end=>left>end+4);if(at>=0)ends[at]=left+size2;return{text,at,middle:left+size2/2}})}var around2=(u,turn)=>(u%
turn+turn)%turn;function icon(pause){return s("svg",{width:12,height:12,viewBox:"0 0 12 12","aria-hidden":"true"},s("path",{d:pause?"M1 0h3.5v12H1zM7.5 0H11v12H\
7.5z":"M1 0l11 6l-11 6z"}))}function driveOf(dyad,place){if(dyad.kind==="PR")return alongLine(dyad,place);if(dyad.kind==="RP")return place.a+radians(dyad.line.normal_deg);const[x,y]=act(place,
dyad.moving_pivot);return Math.atan2(y-dyad.fixed_pivot[1],x-dyad.fixed_pivot[0])}function transmissionOf(driver,follower,place){if(driver.kind==="PP"||follower.
kind==="PP")return null;const slot=dyad=>{const[nx,ny]=normalOf(dyad),c=Math.cos(place.a),d=Math.sin(place.a);return[c*nx-d*ny,d*nx+c*ny]};if(driver.kind==="RP"&&
follower.kind==="RP")return 90;if(follower.kind==="RP"){const pin=act(place,driver.moving_pivot),[x,y]=follower.fixed_pivot;return between(slot(follower),[x-pin[0],
y-pin[1]])}const end=act(place,follower.moving_pivot);const lever=follower.kind==="PR"?normalOf(follower):[end[0]-follower.fixed_pivot[0],end[1]-follower.fixed_pivot[1]];
if(driver.kind==="RP")return between(slot(driver),lever);const start=act(place,driver.moving_pivot);return between([end[0]-start[0],end[1]-start[1]],lever)}var between=(a,b)=>Math.
atan2(Math.abs(a[0]*b[1]-a[1]*b[0]),Math.abs(a[0]*b[0]+a[1]*b[1]))*180/Math.PI;var APART=3;var GOLDEN=.381966011250105;var HALVINGS=24;function drivenByOther(linkage,length){const led=[linkage.led[1],linkage.led[0]];if(led[0].kind==="PP"||
!linkage.ways.length)return{...linkage,led,loads:null,ways:[],pose_errors:linkage.pose_errors.map(row=>({...row,way:null,frame:null,at:null}))};const ways=[],places=Array(
linkage.pose_errors.length).fill(null);for(const chain of chainsOf(linkage.ways)){for(const piece of piecesOf(linkage,led[0],chain,length)){const way=wayOf(linkage,
led,piece,chain,length);const number=ways.push(way)-1;linkage.pose_errors.forEach((row,k)=>{const frame=places[k]||row.way===null?null:frameIn(piece,row,linkage.
ways[row.way].x.length-1);if(frame===null)return;places[k]=[number,way.falls?piece.stations.length-1-frame:frame];way.poses.push(k+1)})}}const named=new Map;for(const way of ways){
way.branches=ways.filter(each=>each.circuit===way.circuit).length;named.set(way.circuit,(named.get(way.circuit)??0)+1);way.branch=named.get(way.circuit)}const pose_errors=linkage.
pose_errors.map((row,k)=>({...row,way:places[k]?.[0]??null,frame:places[k]?.[1]??null,at:places[k]?ways[places[k][0]]:null,transmission_deg:row.x===null?null:transmissionOf(
led[0],led[1],{x:row.x,y:row.y,a:row.angle_deg*Math.PI/180})}));return{...linkage,led,loads:null,ways,pose_errors}}function chainsOf(ways){const chains=[];for(const circuit of new Set(
ways.map(way=>way.circuit))){const own=ways.map((way,number)=>({way,number})).filter(({way})=>way.circuit===circuit);const stations=({way,number},turned)=>{const all=Array.
from(way.x,(_,u)=>({way:number,u}));return turned?all.reverse():all};const[one,other]=own;const joined=(end,start)=>other&&one.way.dead[end]&&other.way.dead[start]&&
near(one.way,end,other.way,start);if(!other||!(joined(0,0)||joined(1,1))){for(const each of own)chains.push({circuit,closed:each.way.round,stations:stations(each,
false)});continue}const closed2=joined(0,0)&&joined(1,1),high=joined(1,1);const through=[...stations(one,!high),...stations(other,high).slice(1)];chains.push({circuit,
closed:closed2,stations:through})}return chains}function near(one,end,other,start){const at=(way,k)=>[way.x[k],way.y[k]],last=(way,k)=>k?way.x.length-1:0;const[
i,j]=[last(one,end),last(other,start)],inner=end?i-1:1;const step=Math.hypot(...at(one,i).map((v,k)=>v-at(one,inner)[k]));const away=Math.hypot(...at(one,i).map(
(v,k)=>v-at(other,j)[k]));return away<=APART*step+1e-9*Math.hypot(...at(one,i))}function piecesOf(linkage,driver,{circuit,closed:closed2,stations},length){const placeOf=({
way,u})=>placeAt(linkage,linkage.ways[way],u,length);const slides=driver.kind==="PR";let before=null;const driveAt=station=>{let drive=driveOf(driver,placeOf(station));
if(!slides&&before!==null)drive-=2*Math.PI*Math.round((drive-before)/(2*Math.PI));return drive};const drives=stations.map(station=>before=driveAt(station));const count=stations.
length-1,sense=k=>Math.sign(drives[k+1]-drives[k]);const cuts=[];for(let k=1;k<count;k+=1)if(sense(k)*sense(k-1)<0)cuts.push(k);if(closed2&&sense(0)*sense(count-
1)<0)cuts.push(0);if(!cuts.length)return[{circuit,round:closed2,dead:[false,false],stations}];const dead=new Map(cuts.map(k=>[k,extreme(k)]));function extreme(k){
const here=stations[k],up=drives[k]>drives[k===0?1:k-1]?1:-1;before=drives[k];const sides=[k>0?k-1:count-1,k+1].map(at2=>{const there=stations[at2];if(there.way===
here.way&&Math.abs(there.u-here.u)<1.5)return[here.way,here.u,there.u];return[there.way,there.u,there.u<1.5?0:there.u+1]});const value=(way,u)=>up*driveAt({way,
u});let best={station:here,value:value(here.way,here.u)};for(const[way,u,v]of sides){let[low,high]=[Math.min(u,v),Math.max(u,v)];for(let step=0;step<HALVINGS;step+=
1){const[a,b]=[low+GOLDEN*(high-low),high-GOLDEN*(high-low)];if(value(way,a)<value(way,b))low=a;else high=b}const station={way,u:(low+high)/2},found=value(way,station.
u);if(found>best.value)best={station,value:found}}return best.station}const part=(from,to)=>{const inner=[];for(let k=from+1;k<to;k+=1)inner.push(stations[closed2?
k%count:k]);const ends=[from,to].map(k=>dead.get(closed2?k%count:k)??stations[k]);return[ends[0],...inner.filter(each=>!ends.some(end=>end.way===each.way&&Math.
abs(end.u-each.u)<.001)),ends[1]]};cuts.sort((a,b)=>a-b);if(closed2){const at2=[...cuts,cuts[0]+count];return at2.slice(1).map((to,k)=>({circuit,round:false,dead:[
true,true],stations:part(at2[k],to)}))}const at=[0,...cuts,count];return at.slice(1).map((to,k)=>({circuit,round:false,dead:[k>0,to<count],stations:part(at[k],to)}))}
function wayOf(linkage,led,piece,chain,length){const slides=led[0].kind==="PR",places=piece.stations.map(({way,u})=>({...placeAt(linkage,linkage.ways[way],u,length)}));
const drive=[];places.forEach((place,k)=>{let value=driveOf(led[0],place);if(!slides&&k)value-=2*Math.PI*Math.round((value-drive[k-1])/(2*Math.PI));if(k)place.a-=
2*Math.PI*Math.round((place.a-places[k-1].a)/(2*Math.PI));drive.push(value)});const falls=drive[drive.length-1]<drive[0];if(falls)[drive,places].forEach(each=>each.
reverse());const turns=slides?0:2*Math.PI*Math.round((drive[0]+drive[drive.length-1])/(4*Math.PI));return{circuit:chain.circuit,round:piece.round,dead:falls?[...piece.
dead].reverse():piece.dead,poses:[],falls,drive:drive.map(value=>slides?value:degrees(value-turns)),x:places.map(({x})=>x),y:places.map(({y})=>y),angle:places.map(
({a})=>a),transmission:places.map(place=>transmissionOf(led[0],led[1],place))}}function frameIn({stations},{way,frame},last){for(let k=0;k+1<stations.length;k+=
1){const[a,b]=[stations[k],stations[k+1]];if(a.way!==way||b.way!==way){if(a.way===way&&Math.abs(a.u-frame)<1e-9)return k;if(b.way===way&&Math.abs(b.u-frame)<1e-9)
return k+1;continue}const[u,v]=Math.abs(b.u-a.u)>last/2?[a,b].map(each=>each.u+(each.u<last/2?last:0)):[a.u,b.u];for(const at of[frame,frame+last]){if(at>=Math.
min(u,v)-1e-9&&at<=Math.max(u,v)+1e-9)return u===v?k:k+(at-u)/(v-u);if(Math.max(u,v)<=last)break}}return null}var REDUCED_MOTION="(prefers-reduced-motion: reduce)";var AT_POSE=1e-6;var Playing=class extends Events{constructor(store,answers){super();this.store=store;this.
answers=answers;this.isOther=false;this.here=null;this.player=new Player(answers.data,(place,drive,transmission,near2)=>this.placed({place,drive,transmission,near:near2}),
()=>this.rebuild());this.assemblies=new Assemblies(answers.data,index=>this.player.take(index));this.drivers=h("fieldset",{class:"bm-ways bs-drivers",hidden:true});
this.note=h("p",{class:"bs-quiet bs-driver-note"});this.element=h("div",{class:"bs-player"},this.player.element,h("div",{class:"bs-player-ways"},this.drivers,this.
assemblies.element),this.note);this.words=new Pace(()=>this.player.path&&this.player.show());this.marks=new Pace(()=>this.player.drawStops());answers.on("answer\
s shown placed",()=>this.load());answers.on("moved",()=>this.follow());store.on("selection",()=>this.goToSelected());store.on("state",()=>this.hush());new ResizeObserver(
()=>this.marks.ask()).observe(this.element);this.load()}get linkage(){return this.player.linkage}get path(){return this.player.path}load(){const base=this.answers.
shown??null;if(base===this.base&&base){this.follow();this.tellDriver();return}this.base=base;this.isOther=false;this.at=null;this.dress();if(!base){this.player.
linkage=null;this.player.way=0;this.player.play(false);for(const each of[this.assemblies.element,this.drivers])give(each,"hidden",true);say(this.note,"");this.element.
classList.add("bs-empty");this.emit("shape",false);return}this.element.classList.remove("bs-empty");this.player.load(this.driven());this.goToSelected()}driven(){
return this.isOther?drivenByOther(this.base,this.answers.data.chart.length):this.base}driveBy(other){this.isOther=other;this.player.linkage=this.driven();this.at=
null;this.takeBest();this.rebuild();this.tellDriver()}takeBest(){const counts=this.linkage.ways.map(way=>way.poses.length);this.player.way=Math.max(0,counts.indexOf(
Math.max(...counts)));this.player.u=this.player.firstStop()}follow(){const{base,player}=this;if(!base)return;player.linkage=this.driven();const row=this.at?.pose===
void 0?null:player.linkage.pose_errors[this.at.pose];if(row&&row.way!==null){player.way=row.way;player.u=row.frame}else if(!player.path){if(player.linkage.ways.
length)this.takeBest()}else if(this.at){player.u=this.frameOf(player.path,this.at.drive)}player.rebuild();this.emit("shape",true);player.show(false);this.words.
ask();this.marks.ask()}frameOf(way,drive){if(drive===null||this.linkage.led[0].kind==="PR")return frameAt(way.drive,drive??way.drive[0]);const middle2=(way.drive[0]+
way.drive[way.drive.length-1])/2;return frameAt(way.drive,drive-360*Math.round((drive-middle2)/360))}rebuild(){const{player}=this;player.rebuild();this.assemblies.
build(this.linkage,player.way);this.buildDrivers();this.emit("shape",false);this.marks.ask();player.show()}placed(here){this.here=here;const{path,u}=this.player;
const pose=this.linkage.pose_errors.findIndex(row=>row.at===path&&Math.abs(row.frame-u)<AT_POSE);this.at={drive:here.drive,pose:pose<0?void 0:pose};this.emit("p\
lace",here)}goToSelected(){const{selection}=this.store,{player}=this;if(selection?.kind!=="pose"||player.playing)return;const row=this.linkage?.pose_errors[selection.
index];if(!row||row.way===null)return;const other=row.way!==player.way;player.way=row.way;player.u=row.frame;if(other)this.rebuild();else player.go(row.frame)}buildDrivers(){
const{base}=this;give(this.drivers,"hidden",!base||!base.ways.length||base.led.some(dyad=>dyad.kind==="PP"));if(this.drivers.hidden)return;const key=`${base.id}\
 ${base.led.map(dyad=>dyad.id)} ${this.isOther}`;if(key===this.driversKey)return;this.driversKey=key;const one=(dyad,other)=>h("label",{},h("input",{type:"radio",
name:"bs-driver",checked:other===this.isOther,"data-driver":dyad.id,onchange:()=>this.driveBy(other)}),h("span",{},h("b",{},dyad.id),` ${{RR:"crank or rocker",PR:"\
slider on its rail",RP:"slot"}[dyad.kind]}`));this.drivers.replaceChildren(h("legend",{},"Driver"),one(base.led[0],false),one(base.led[1],true));this.tellDriver()}tellDriver(){
const{base}=this;if(!base?.drives||base.followed){say(this.note,"");return}const driver=this.isOther?base.led[1]:base.led[0];const drive=base.dyads[0].id===driver.
id?base.drives.first:base.drives.second;const least2=drive.min_transmission_angle_deg.range;const said=drive.defects.length?drive.defects.map(each=>each.message).
join("; "):`${drive.turns_fully?"turns fully":"reaches every pose"}${least2===null?"":`, transmission angle ${fixed(least2,1)}° or more between the poses`}`;say(
this.note,`Driven by ${driver.id}: ${said}.`)}dress(){this.driversKey=null}hush(){const quiet=this.store.state==="dragging"||this.player.playing;put(this.player.
readout,"aria-live",quiet?"off":"polite")}};function playOnce(store,answers,{player}){if(matchMedia(REDUCED_MOTION).matches)return;let first=true;answers.on("an\
swers",()=>{if(first&&player.path){first=false;player.playOnce()}});store.on("document selection",()=>{first=false;if(player.remaining!==null)player.play(false)})}var LONGEST_ARM=46;var SHORTEST_ARM=27;var FEW=24;var MOST=240;var ROOM2=14;var NAME2=14;var LONGEST_NAME2=18;var ARROWS2={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[
0,1],ArrowDown:[0,-1]};var tenths=angle=>Number(angle.toFixed(1))+0;var unwrapped=(angle,near2)=>angle+360*Math.round((near2-angle)/360);var strideOf=({poses},scale)=>{
const length=poses.slice(1).reduce((sum,{x,y},k)=>sum+(Math.hypot(x-poses[k].x,y-poses[k].y)||0),0);return poses.length<=FEW?1:Math.ceil(poses.length/clamp(scale*
length/ROOM2,FEW,MOST))};function drawnPoses({document:document2,selection},scale){const{poses}=document2,count=poses.length,all=[...poses.keys()];if(count<=FEW)
return all;const stride=strideOf(document2,scale),chosen=selection?.kind==="pose"?selection.index:-1;return all.filter(k=>k%stride===0||k===count-1||k===chosen)}
var PoseHandles=class{constructor(store,scene){this.store=store;this.scene=scene;this.element=scene.layer("poses");this.names=scene.layer("labels");this.kept=new Kept(
this.element,k=>this.make(k),(group,k)=>this.show(group,k));this.labels=new Kept(this.names,()=>s("text",{class:"bs-pose-name"}),(text,k)=>this.showName(text,k));
store.on("document selection",()=>this.draw());scene.on("view",()=>this.draw());scene.hold(()=>store.document.poses.map((_,k)=>standing(store.document,k)).map(({
x,y})=>[x,y]));scene.on("click",()=>store.select(null));scene.names.avoid(()=>this.obstacles());this.draw()}get arm(){const{document:document2}=this.store,{scale}=this.
scene.view,places=drawnPoses(this.store,scale).map(k=>standing(document2,k));const away=places.slice(1).map(({x,y},k)=>scale*Math.hypot(x-places[k].x,y-places[k].
y)).sort((a,b)=>a-b);return away.length?clamp(1.2*away[away.length>>1],SHORTEST_ARM,LONGEST_ARM):LONGEST_ARM}draw(){this.length=this.scene.dragged?this.length??
this.arm:this.arm;const poses=drawnPoses(this.store,this.scene.view.scale).map(k=>[k,k]);this.kept.draw(poses);this.labels.draw(poses.length>FEW&&isPath(this.store.
document)?[]:poses)}make(k){const origin=s("g",{class:"bs-origin","data-pose":k+1,tabindex:0,role:"button"},s("circle",{class:"bs-hold",r:12}),s("circle",{class:"\
bs-dot",r:5.5}));const turn=s("g",{class:"bs-turn","data-turn":k+1,tabindex:0,role:"slider","aria-valuemin":-360,"aria-valuemax":360},s("circle",{class:"bs-hold",
r:12}),s("circle",{class:"bs-tip",r:5}));const group=s("g",{class:"bs-pose"},s("path",{class:"bs-axes"}),origin,turn);this.dragOrigin(origin,k);this.dragTurn(turn,
k);for(const part of[origin,turn])part.addEventListener("focus",()=>this.store.select({kind:"pose",index:k}));origin.addEventListener("keydown",event=>this.key(
event,k,false));turn.addEventListener("keydown",event=>this.key(event,k,true));return group}show(group,k){const{store,scene:{view}}=this,{x,y,angle}=standing(store.
document,k),pose=store.document.poses[k];const selected=store.selection?.kind==="pose"&&store.selection.index===k,unit=store.document.length_unit??"",name=poseName2(
store.document,k);const point=isPoint2(pose);if(!isOther(group,[view,this.length,x,y,angle,Boolean(pose.exact),pose.name,name,unit,selected,point]))return;const[
arrow2,origin,turn]=group.children;put(group,"transform",transform(view.X(x),view.Y(y),point?0:radians(angle)));for(const part of[arrow2,turn])put(part,"display",
point?"none":"inline");group.classList.toggle("bs-point",point);put(arrow2,"d",axes(this.length-8));put(turn,"transform",`translate(${px(this.length)} 0)`);group.
classList.toggle("bs-selected",selected);group.classList.toggle("bs-exact",Boolean(pose.exact));const what=point?"Point":"Pose",called=pose.name?`${what} ${k+1}\
, ${name}`:`${what} ${k+1}`;put(origin,"aria-label",`${called}: x ${x} ${unit}, y ${y} ${unit}, ${point?"angle free":`angle ${angle}°`}. Drag, or use the arrow\
 keys; Delete removes it.`);put(origin,"aria-pressed",selected);put(turn,"aria-label",`Turn ${called}`);put(turn,"aria-valuenow",angle);put(turn,"aria-valuetext",
`${angle}°`)}obstacles(){const{store,scene:{view},length}=this,boxes=[];for(const k of drawnPoses(store,view.scale)){const{x,y,angle}=standing(store.document,k),
a=radians(angle),[c,d]=[Math.cos(a),Math.sin(a)];const at=(along2,across,size2)=>boxes.push([view.X(x)+along2*c-across*d,view.Y(y)-along2*d-across*c,size2,size2]);
at(0,0,13);if(isPoint2(store.document.poses[k]))continue;at(length,0,12);at(LETTER2,-LETTER2,12);for(const share of[.35,.7])at(share*length,0,6);for(const share of[
.3,.6])at(0,share*(length-8),6)}return boxes}showName(text,k){const{store,scene}=this,{view}=scene,{x,y,angle}=standing(store.document,k),name=shortened(poseName2(
store.document,k),LONGEST_NAME2);if(!isOther(text,[view,x,y,angle,name]))return;say(text,name);scene.names.put(text,view.X(x),view.Y(y),name,around(name,radians(
angle+215),NAME2,scene.names.areMany))}set(k,changes,gesture){this.store.edit(document2=>setPose(document2,k,statedOf(document2.poses[k],changes)),{gesture})}dragOrigin(element,k){
const{store,scene}=this;let gesture,off,before,reach;scene.drag(element,{start:from=>{const{x,y}=standing(store.document,k);gesture=Symbol("move a pose");off=[x-
from.x,y-from.y];before=store.document;reach=isPath(before)?strideOf(before,scene.view.scale):1},move:point=>reach>1?this.bend(before,k,reach,[point.x+off[0]-before.
poses[k].x,point.y+off[1]-before.poses[k].y],gesture):this.set(k,{x:scene.rounded(point.x+off[0]),y:scene.rounded(point.y+off[1])},gesture),cancel:()=>store.abandon(
gesture)})}bend({poses,path},k,reach,[dx,dy],gesture){const count=poses.length;const moved=poses.map((pose,j)=>{const away=path?.closed?Math.min(Math.abs(j-k),count-
Math.abs(j-k)):Math.abs(j-k),share=1-away/reach;return share>0?{...pose,x:this.scene.rounded(pose.x+share*dx),y:this.scene.rounded(pose.y+share*dy)}:pose});this.
store.edit(document2=>({...document2,poses:moved}),{gesture})}dragTurn(element,k){const{store,scene}=this;let gesture,off;const angleTo=point=>{const{x,y}=standing(
store.document,k);return degrees(Math.atan2(point.y-y,point.x-x))};scene.drag(element,{start:from=>{gesture=Symbol("turn a pose");off=standing(store.document,k).
angle-angleTo(from)},move:point=>this.set(k,{angle:tenths(unwrapped(angleTo(point)+off,standing(store.document,k).angle))},gesture),cancel:()=>store.abandon(gesture)})}key(event,k,turning){
const{store,scene}=this,arrow2=ARROWS2[event.key];if(event.ctrlKey||event.metaKey)return;if(arrow2){if(!event.repeat)this.keyed=Symbol("keys");const{x,y,angle}=standing(
store.document,k),by=stepOf(event,turning?1:scene.step);if(turning)this.set(k,{angle:stepped(angle,by*(arrow2[0]===0?arrow2[1]:-arrow2[0]))},this.keyed);else this.
set(k,{x:stepped(x,by*arrow2[0]),y:stepped(y,by*arrow2[1])},this.keyed)}else if(event.key==="Delete"||event.key==="Backspace"){store.edit(document2=>removePose(
document2,k));const left=store.document.poses.length;store.select(left?{kind:"pose",index:Math.min(k,left-1)}:null);this.focus(Math.min(k,left-1))}else{return}event.
preventDefault()}focus(k){this.element.querySelector(`[data-pose="${k+1}"]`)?.focus({preventScroll:true})}};var PoseTool=class{constructor(store,scene){this.store=store;this.scene=scene;this.name="pose";this.gesture=null;this.hint="Click where the pose is to stand, an\
d click again to turn it. Escape ends."}click(point){const{store,scene}=this;if(this.gesture){this.turn(point);this.gesture=null;return}this.gesture=Symbol("add\
 a pose");const angle=store.document.poses.findLast(pose=>Number.isFinite(pose.angle))?.angle??0;store.edit(document2=>addPose(document2,{x:scene.rounded(point.
x),y:scene.rounded(point.y),angle}),{gesture:this.gesture});store.select({kind:"pose",index:store.document.poses.length-1})}hover(point){if(this.gesture&&point)
this.turn(point)}turn(point){const{store,gesture}=this,k=store.document.poses.length-1,{x,y,angle}=standing(store.document,k);const away=Math.hypot(point.x-x,point.
y-y)*this.scene.view.scale;if(away<6)return;const next=tenths(unwrapped(degrees(Math.atan2(point.y-y,point.x-x)),angle));store.edit(document2=>setPose(document2,
k,{angle:next}),{gesture})}key(event){if(event.key!=="Escape")return false;if(this.gesture)this.store.abandon(this.gesture);this.gesture=null;this.scene.use(null);
return true}};var ROUNDING=1e-6;var MOST_PLACES2=90;var KEYS=["fixed_pivot","moving_pivot"];function currentLinkage(store){if(store.chosen==="placed")return store.placed?.linkage??
null;const followed=store.followed?.linkages.find(({id})=>id===store.chosen);if(followed?.led)return followed;if(store.followed?.vanished?.some(({id})=>id===store.
chosen))return null;return store.solved?.linkages.find(({id})=>id===store.chosen)??null}var PIVOT={fixed_pivot:"fixed pivot",moving_pivot:"moving pivot"};function missed(table,dyad,slack){
const found=[];for(const key of KEYS){if(!table[key])continue;const[[shape,stated]]=Object.entries(table[key]),points=shape==="point"?[stated]:stated;const away=dyad[key]?
distanceTo(dyad[key],shape,points):Infinity;if(away>slack)found.push({key,dyad:dyad.id,away})}const{least:least2=0,most=Infinity}=table.length??{};if(table.length&&
dyad.kind==="RR"&&(dyad.radius<least2-slack||dyad.radius>most+slack)){found.push({key:"length",dyad:dyad.id,away:Math.max(least2-dyad.radius,dyad.radius-most)})}
if(table.kinds&&!table.kinds.includes(dyad.kind))found.push({key:"kinds",dyad:dyad.id,away:Infinity});return found}function limitsMissed(document2,linkage,size2){
const tables=limitsOf(document2),slack=ROUNDING*size2,[one,other]=linkage.led;if(tables.length<2)return tables.map(table=>[...missed(table,one,slack),...missed(
table,other,slack)]);const pairings=[[one,other],[other,one]].map(dyads=>dyads.map((dyad,k)=>missed(tables[k],dyad,slack)));const total=lists=>lists.flat().length;
return total(pairings[1])<total(pairings[0])?pairings[1]:pairings[0]}function missedSentence({key,dyad,away},unit){const by=`${Number(away.toPrecision(2))}${unit?
` ${unit}`:""}`;if(key==="kinds")return`${dyad} is of another kind.`;if(key==="length")return`The link of ${dyad} is ${by} beyond its range.`;return away===Infinity?
`${dyad} has no ${PIVOT[key]}.`:`The ${PIVOT[key]} of ${dyad} is ${by} outside.`}function usedPlaces(linkage){const rows=(linkage.pose_errors??[]).filter(row=>row.
way!==null&&row.frame!==null);if(!rows.length||!linkage.ways?.length)return[];const counts=new Map;for(const{way:way2}of rows)counts.set(way2,(counts.get(way2)??
0)+1);const[best]=[...counts].sort((a,b)=>b[1]-a[1])[0],way=linkage.ways[best];const frames=rows.filter(row=>row.way===best).map(({frame})=>frame);const low=Math.
floor(Math.min(...frames)),high=Math.ceil(Math.max(...frames)),stride=Math.max(1,Math.ceil((high-low)/MOST_PLACES2));const places=[];for(let k=low;k<=high&&k<way.
x.length;k+=stride)places.push({x:way.x[k],y:way.y[k],a:way.angle[k]});return places}var regionCorners=region=>region.polygon??(region.box?boxCorners(region.box):
null);var seen=(body,place)=>body.map(corner=>act(place,corner));function posePlace(document2,k){const{x,y,angle}=standing(document2,k);return{x,y,a:radians(angle)}}
function regionsTouched(document2,linkage,body){const places=usedPlaces(linkage),width=document2.surroundings?.link_width??0,margin=document2.surroundings?.margin??
0;const apart=Math.ceil(document2.poses.length/MOST_PLACES2),some=[...document2.poses.keys()].filter(k=>k%apart===0);return regionsOf(document2).map(region=>{const corners=regionCorners(
region);if(!corners)return"";const pose=body.length>2?some.find(k=>overlap2(seen(body,posePlace(document2,k)),corners)):void 0;if(pose!==void 0)return`The body \
touches it at pose ${poseName2(document2,pose)}.`;if(!places.length)return"";if(body.length>2&&places.some(place=>overlap2(seen(body,place),corners)))return"The\
 body touches it.";for(const dyad of linkage.led){if(dyad.kind!=="RR")continue;const near2=Math.min(...places.map(place=>segmentFromPolygon([dyad.fixed_pivot,act(
place,dyad.moving_pivot)],corners)));if(near2===0||near2<width/2)return`The link of ${dyad.id} touches it.`;if(near2<width/2+margin)return`The link of ${dyad.id}\
 comes nearer than the margin.`}return""})}var LONGEST_NAME3=22;var ABOVE=10;var HATCH=9;var PIVOT2={fixed_pivot:"Fixed pivot",moving_pivot:"Moving pivot"};function limitName(document2,{table,key}){return`${PIVOT2[key]}${limitsOf(
document2).length>1?` of dyad ${table+1}`:""}`}function regionShape(region){if(region.box)return{shape:"box",points:region.box};return region.polygon?{shape:"po\
lygon",points:region.polygon}:null}var Regions=class{onjudged;constructor(store,scene){this.store=store;this.scene=scene;this.shapes=new Map;scene.layer("region\
s").append(s("defs",{},s("pattern",{id:"bs-hatch",width:HATCH,height:HATCH,patternUnits:"userSpaceOnUse",patternTransform:"rotate(45)"},s("path",{class:"bm-hatc\
h",d:`M0 0V${HATCH}`}))));this.regions=new Kept(s("g"),(key,k)=>this.makeRegion(k),element=>this.shapes.get(element).draw());this.footprint=new Kept(s("g"),()=>this.
makeFootprint(),element=>this.shapes.get(element).draw());this.limits=new Kept(s("g"),(key,limit)=>this.makeLimit(limit),element=>this.shapes.get(element).draw());
this.names=new Kept(s("g",{class:"bs-region-names","aria-hidden":"true"}),()=>s("text",{}),(text,name)=>this.showName(text,name));scene.layer("regions").append(
this.regions.group,this.footprint.group);scene.layer("limits").append(this.limits.group);scene.layer("labels").append(this.names.group);store.on("document",()=>this.
judge(store.state==="dragging"&&!this.isOther()));store.on("selection",()=>this.draw());store.on("solved followed chosen placed",()=>this.judge());scene.on("vie\
w",()=>this.draw());scene.hold(()=>limitRegions(store.document).filter(({shape})=>shape!=="line").flatMap(each=>this.corners(each)));scene.hold(()=>regionsOf(store.
document).map(regionShape).filter(Boolean).flatMap(({shape,points})=>outlineOf(shape,points)),true);this.judge()}place({key}){return key==="moving_pivot"?referencePlace(
this.store):GROUND}corners(limit){return outlineOf(limit.shape,limit.points).map(point=>act(this.place(limit),point))}isOther(){const{body,keep_out,surroundings}=this.
store.document,now=[body,keep_out,surroundings];return now.some((each,k)=>each!==this.judged?.[k])}judge(pivots=false){const{document:document2,solved}=this.store,
linkage=currentLinkage(this.store);this.broken=linkage?.led?limitsMissed(document2,linkage,solved?.scene??1):null;if(!pivots){this.judged=[document2.body,document2.
keep_out,document2.surroundings];this.touched=linkage?.led?regionsTouched(document2,linkage,bodyOf(document2)):null}this.draw();this.onjudged?.()}said(table,key){
return this.broken?.[table]?.filter(each=>each.key===key).map(each=>missedSentence(each,this.store.document.length_unit))??null}draw(){const{document:document2}=this.
store,regions=regionsOf(document2),limits=limitRegions(document2),{footprint}=document2.requirements??{};this.regions.draw(regions.map((region,k)=>[k,k]).filter(
([k])=>regionShape(regions[k])));this.limits.draw(limits.map(limit=>[`${limit.table} ${limit.key}`,limit]));this.footprint.draw(footprint?[["footprint",footprint]]:
[]);for(const[element,handles]of this.shapes){if(element.parentNode)continue;handles.clear();this.shapes.delete(element)}this.names.draw([...regions.map((region,k)=>[
`region ${k}`,region.name&&regionShape(region)?{text:region.name,at:middle(outlineOf(...Object.values(regionShape(region))))}:null]),...limits.map(limit=>[`limi\
t ${limit.table} ${limit.key}`,{text:limitName(document2,limit),at:middleOf(this.corners(limit),limit.key==="moving_pivot"),off:limit.key==="moving_pivot"?ABOVE:
-ABOVE,width:widthOf(this.corners(limit))}]),["footprint",footprint?{text:"Footprint",at:middleOf(footprint.polygon??outlineOf("box",footprint.box),true),off:ABOVE,
width:widthOf(footprint.polygon??footprint.box)}:null]].filter(([,name])=>name))}kept(handles){this.shapes.set(handles.element,handles);return handles.element}makeRegion(k){
const{store}=this;const handles=new ShapeHandles(this.scene,{className:"bs-region",what:()=>{const region=regionsOf(store.document)[k];return{...regionShape(region),
place:GROUND,name:region.name?`Keep out: ${region.name}`:`Region ${k+1} to keep out of`,selected:store.selection?.kind==="region"&&store.selection.index===k,state:this.
touched?this.touched[k]?"broken":"met":"",data:{region:k}}},set:(points,gesture)=>store.edit(document2=>setRegion(document2,k,shapeOf(regionShape(regionsOf(document2)[k]).
shape,points)),{gesture}),remove:()=>this.removeRegion(k),select:()=>store.select({kind:"region",index:k}),abandon:gesture=>store.abandon(gesture)});handles.element.
insertBefore(s("path",{class:"bs-hatched",fill:"url(#bs-hatch)"}),handles.area);const draw=handles.draw.bind(handles);handles.draw=()=>{draw();handles.element.querySelector(
".bs-hatched").setAttribute("d",handles.line.getAttribute("d"))};return this.kept(handles)}removeRegion(k){this.store.edit(document2=>removeRegion(document2,k));
this.store.select(null);this.scene.svg.focus({preventScroll:true})}makeLimit({table,key}){const{store}=this,place=()=>this.place({key});const at=()=>limitRegions(
store.document).findIndex(each=>each.table===table&&each.key===key);return this.kept(new ShapeHandles(this.scene,{className:`bs-limit bs-${key.replace("_","-")}`,
what:()=>{const index=at(),limit=limitRegions(store.document)[index],said=this.said(table,key);return{...limit,place:place(),name:`Limit: ${limitName(store.document,
limit)}`,selected:store.selection?.kind==="limit"&&store.selection.index===index,state:said?said.length?"broken":"met":"",data:{limit:index,plane:key==="moving_\
pivot"?"M":"F"}}},set:(points,gesture)=>store.edit(document2=>setLimit(document2,table,{[key]:shapeOf(Object.keys(limitsOf(document2)[table][key])[0],points)}),
{gesture}),remove:()=>this.removeLimit(table,key),select:()=>store.select({kind:"limit",index:at()}),abandon:gesture=>store.abandon(gesture)}))}removeLimit(table,key){
this.store.edit(document2=>setLimit(document2,table,{[key]:void 0}));this.store.select(null);this.scene.svg.focus({preventScroll:true})}makeFootprint(){const{store}=this,
shape=()=>Object.keys(store.document.requirements.footprint)[0];return this.kept(new ShapeHandles(this.scene,{className:"bs-footprint",what:()=>({shape:shape(),
points:store.document.requirements.footprint[shape()],place:GROUND,name:"Footprint: holds all pivots",selected:store.selection?.kind==="footprint",data:{footprint:""}}),
set:(points,gesture)=>store.edit(document2=>setRequirement(document2,"footprint",{[shape()]:points}),{gesture}),remove:()=>{store.edit(document2=>setRequirement(
document2,"footprint",void 0));store.select(null)},select:()=>store.select({kind:"footprint",index:0}),abandon:gesture=>store.abandon(gesture)}))}showName(text,{
text:name,at:[x,y],off,width}){const{scene}=this,{view}=scene,shown2=shortened(name,LONGEST_NAME3);say(text,shown2);put(text,"class",off?"bs-limit-name":"bs-reg\
ion-name");scene.names.put(text,view.X(x),view.Y(y),shown2,off?along(off,view.scale*(width??0)):[[0,0,0]])}regionTool(shape){const{store}=this;return new ShapeTool(
this.scene,{shape,name:`region ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>addRegion(document2,{[shape]:points}));store.select({kind:"region",
index:regionsOf(store.document).length-1})}})}limitTool(table,key,shape){const{store}=this;return new ShapeTool(this.scene,{shape,name:`limit ${table} ${key} ${shape}`,
place:()=>this.place({key}),done:points=>{store.edit(document2=>setLimit(document2,table,{[key]:shapeOf(shape,points)}));store.select({kind:"limit",index:limitRegions(
store.document).findIndex(each=>each.table===table&&each.key===key)})}})}footprintTool(shape){const{store}=this;return new ShapeTool(this.scene,{shape,name:`foo\
tprint ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>setRequirement(document2,"footprint",{[shape]:points}));store.select({kind:"footprint",index:0})}})}};
function middle(points){const[x,y,u,v]=bounds(points);return[(x+u)/2,(y+v)/2]}function middleOf(points,upper){const[x,y,u,v]=bounds(points);return[(x+u)/2,upper?
v:y]}function widthOf(points){const[x,,u]=bounds(points);return Number.isFinite(u-x)?u-x:0}var ORDERS={rank:{name:"best first",of:linkage=>linkage.rank??Infinity},worst:{name:"worst miss",of:linkage=>linkage.worst??Infinity},least:{name:"transmission \
angle",of:linkage=>-(linkage.least??-1)},size:{name:"size",of:linkage=>linkage.quality?.extent??Infinity},sensitivity:{name:"sensitivity",of:linkage=>linkage.quality?.
sensitivity??Infinity}};var FILTERS={all:{name:"all",holds:()=>true},usable:{name:"usable",holds:linkage=>linkage.usable},pinned:{name:"pinned",holds:(linkage,pinned)=>pinned.
has(linkage.id)}};function arranged(linkages,{order,filter,type,pinned}){const{of}=ORDERS[order],{holds}=FILTERS[filter];return linkages.filter(each=>holds(each,
pinned)&&(!type||each.type===type)).map((each,k)=>({each,k,key:of(each)})).sort((a,b)=>Number(pinned.has(b.each.id))-Number(pinned.has(a.each.id))||(a.key===b.key?
0:a.key-b.key)||a.k-b.k).map(({each})=>each)}var FIGURES=[["worst","worst miss"],["least","transmission"],["size","size"],["sensitivity","sensitivity"]];var ResultCard=class{constructor(does){this.name=h("\
b",{});this.type=h("span",{class:"bm-type"});this.was=h("span",{class:"bs-was"});this.verdict=h("span",{class:"bm-verdict"});this.figures=new Map(FIGURES.map(([
key])=>[key,h("dd",{"data-figure":key})]));this.worst=h("dt",{});this.note=h("span",{class:"bs-card-note"});this.reason=h("span",{class:"bm-reason"});this.help=
h("span",{class:"bs-help"});this.main=h("button",{type:"button",class:"bs-card-main","aria-pressed":"false",onclick:()=>does.choose(this.id)},h("span",{class:"b\
m-choice-head"},this.name," ",this.type," ",this.was),this.verdict,h("dl",{class:"bs-figures"},FIGURES.map(([key,name])=>[key==="worst"?this.worst:h("dt",{},name),
this.figures.get(key)])),this.note,this.reason,this.help);this.pin=h("button",{type:"button",class:"bs-small","aria-pressed":"false",onclick:()=>does.pin(this.id)},
"Pin");this.compare=h("button",{type:"button",class:"bs-small","aria-pressed":"false",onclick:()=>does.compare(this.id)},"Compare");this.improve=h("button",{type:"\
button",class:"bs-small",onclick:()=>does.improve(this.id)},"Look near it");this.letGo=h("button",{type:"button",class:"bs-small",onclick:()=>does.letGo()});this.
better=h("ul",{class:"bs-better","aria-live":"polite"});this.element=h("article",{class:"bs-card bm-choice"},this.main,h("div",{class:"bs-card-tools"},this.pin,
this.compare,this.improve,this.letGo),this.better)}show(linkage,{data,old,chosen,pinned,compared}){const{said}=linkage,{classList}=this.element,isPlaced=linkage.
id===PLACED;if(this.id!==linkage.id||old)this.better.replaceChildren();if(this.id!==linkage.id){this.id=linkage.id;put(this.element,"data-linkage",linkage.id)}say(
this.name,isPlaced?linkage.called:linkage.id);say(this.type,linkage.type);say(this.was,pastOf(linkage));say(this.verdict,linkage.gone?"✕ gone":linkage.usable?
"✓ usable":"✕ not usable");say(this.worst,data.isPath?"path error":"worst miss");say(this.figures.get("worst"),data.isPath?pathErrorOf(linkage,data):worstOf(
linkage,data));say(this.figures.get("least"),least(linkage));say(this.figures.get("size"),said.quality.extent??"–");say(this.figures.get("sensitivity"),said.quality.
sensitivity??"–");say(this.note,linkage.gone??(linkage.usable&&linkage.change||(linkage.usable&&!linkage.followed&&linkage.shortcomings?.length?`Falls short: ${linkage.
shortcomings.join("; ")}`:"")));const reason=linkage.usable||linkage.gone?"":linkage.followed?linkage.reason??"":said.reasons.join("; ");say(this.reason,reason);
say(this.help,reason&&said.help&&!linkage.followed?`What would help: ${said.help}.`:"");classList.toggle("bm-good",linkage.usable&&!linkage.gone);classList.toggle(
"bm-bad",!linkage.usable||Boolean(linkage.gone));classList.toggle("bs-gone",Boolean(linkage.gone));classList.toggle("bs-old",old||Boolean(linkage.followed));classList.
toggle("bs-chosen",chosen);setPressed(this.main,chosen);setPressed(this.pin,pinned);setPressed(this.compare,compared);say(this.pin,pinned?"Pinned":"Pin");give(this.
pin,"hidden",isPlaced);give(this.compare,"hidden",isPlaced||chosen);give(this.improve,"hidden",isPlaced||linkage.usable||old||Boolean(linkage.gone));give(this.letGo,
"hidden",!isPlaced);say(this.letGo,linkage.called==="By hand"?"Let go of the pivots":"Put it away");for(const button2 of[this.pin,this.compare,this.improve])labelled(
button2,linkage.id)}tellBetter(sentences){this.better.replaceChildren(...sentences.map(sentence2=>h("li",{},sentence2)))}};function pastOf({was,shift,isNew,followed}){
if(isNew&&!was)return"new";const moved=shift&&!followed?`moved ${(100*shift).toFixed(1)} %`:"";return[was?`was ${was}`:"",moved].filter(Boolean).join(", ")}function least(linkage){
const angle=leastOf(linkage);return angle==="–"?angle:angle==="0°"?"down to 0°":`${angle} or more`}function setPressed(button2,on){put(button2,"aria-pressed",
Boolean(on))}function labelled(button2,id){put(button2,"aria-label",`${button2.textContent}: ${id}`)}var MOST2=500;var History=class{constructor(){this.past=[];this.future=[]}record(value,gesture){this.future=[];const last=this.past.at(-1);if(gesture!==null&&last?.
gesture===gesture)return;this.past.push({value,gesture});if(this.past.length>MOST2)this.past.shift()}undo(value){const last=this.past.pop();if(!last)return null;
this.future.push(value);return last.value}redo(value){const next=this.future.pop();if(next===void 0)return null;this.past.push({value,gesture:null});return next}abandon(gesture){
if(this.past.at(-1)?.gesture!==gesture)return null;return this.past.pop()?.value}get canUndo(){return this.past.length>0}get canRedo(){return this.future.length>
0}};var REST2=150;var MOST_REST=1e3;var MOST_FLYING=1;var MOST_SHOWN=6;var FEWEST=2;var QUICK=1.2;var NO_ANSWER={linkages:[],dyads:[],best:[],warnings:[],pivot_map:null,
family_map:null,outcome:{message:"Two poses or more make a task"}};var PLACED2="placed";var kindOf=({poses,path})=>`${poses.map(({free})=>free?.join("")??"-").join()}\
 ${path?path.closed:""}`;var Store=class{solving;placing;solved;constructor({connection,document:document2,options={},name="task",settings={},mostFlying=MOST_FLYING}){
this.connection=connection;this.mostFlying=mostFlying;this.renamed=new Map;this.moved=new Map;this.document=document2;this.options=options;this.name=name;this.settings=
settings;this.history=new History;this.solved=null;this.solvedFor=null;this.followed=null;this.followedFor=null;this.state="resting";this.progress="";this.chosen=
null;this.pinned=new Set;this.compared=null;this.placed=null;this.whole=null;this.task=0;this.solvedTask=0;this.selection=null;this.messages=[];this.listeners=new Map;
this.basis=null;this.pending=null;this.flying=new Map;this.placing=null;this.solving=null;connection.on("message",message=>this.take(message));connection.on("op\
en",()=>this.opened());connection.on("closed",()=>this.closed())}on(names,fn){for(const name of[names].flat().join(" ").split(/\s+/)){if(!this.listeners.has(name))
this.listeners.set(name,[]);this.listeners.get(name).push(fn)}}emit(...names){const told=new Set;for(const name of names){for(const fn of this.listeners.get(name)??
[]){if(told.has(fn))continue;told.add(fn);fn(name)}}}edit(change,{gesture=null}={}){const next=change(this.document);if(next===this.document)return;this.history.
record(this.version,gesture);this.document=next;this.changed()}option(name,value){this.history.record(this.version,null);const{[name]:_,...rest}=this.options;this.
options=value===void 0?rest:{...rest,[name]:value};this.changed()}setting(name,value){this.history.record(this.version,null);this.settings=withKeys(this.settings,
{[name]:value});this.emit("document")}rename(name){this.history.record(this.version,null);this.name=name;this.emit("document")}replace({document:document2,options={},
name=this.name,settings=this.settings}){this.history.record(this.version,null);this.tasks=(this.tasks??0)+1;this.document=document2;this.options=options;this.name=
name;this.settings=settings;this.selection=null;this.placed=null;this.task=this.tasks;this.changed();this.emit("selection","placed")}undo(){this.goTo(this.history.
undo(this.version))}redo(){this.goTo(this.history.redo(this.version))}abandon(gesture){this.goTo(this.history.abandon(gesture))}get version(){return{document:this.
document,options:this.options,name:this.name,settings:this.settings,task:this.task}}goTo(version){if(!version)return;const isSame=version.document===this.document&&
version.options===this.options;Object.assign(this,version);if(isSame)this.emit("document");else this.changed()}changed(){if(this.placed?.cognateOf)this.letCognateGo();
this.follow();this.emit("document");if(this.isEmpty)this.forget();if(this.state!=="offline")this.setState("dragging");this.solveAfterRest()}get shown(){return[...new Set(
[this.chosen,this.compared,...this.pinned])].filter(id=>id&&id!==PLACED2).slice(0,MOST_SHOWN)}follow(){if(!this.solved||this.flying.size>=this.mostFlying)return;
if(!this.canFollow){this.solveMeanwhile();return}const{document:document2,options,shown:shown2}=this;const n=this.connection.send({do:"follow",document:document2,
options,shown:shown2});if(n!==null)this.flying.set(n,{document:document2,isOld:false})}get canFollow(){return this.whole!==kindOf(this.document)}get slow(){return this.
canFollow||this.seconds===void 0?null:this.seconds}solveMeanwhile(){if(this.solving||this.state==="offline"||this.isEmpty||this.slow===null||this.slow>QUICK)return;
const{document:document2,options}=this,n=this.connection.send({do:"solve",document:document2,options});if(n!==null)this.solving={n,document:document2,options}}solveAfterRest(){
clearTimeout(this.resting);const since=performance.now();const rest=()=>{if(this.flying.size&&performance.now()-since<MOST_REST)this.resting=setTimeout(rest,REST2/
3);else this.solve()};this.resting=setTimeout(rest,REST2)}solve(){clearTimeout(this.resting);const{document:document2,options}=this;if(this.solving?.document===
document2&&this.solving.options===options){this.setState("solving","");return}const n=this.connection.send({do:"solve",document:document2,options});if(n===null)
return;this.solving={n,document:document2,options};this.setState("solving","")}cancel(){this.connection.send({do:"cancel"})}place(pivots){this.placeWanted=pivots?.
length?pivots:null;if(!this.placeWanted){this.placed=null;this.emit("placed")}else if(!this.placing){this.sendPlace()}}sendPlace(){const{document:document2,options,
placeWanted:pivots}=this;const n=this.connection.send({do:"place",document:document2,options,pivots});this.placing=n===null?null:{n,pivots}}take(message){const{
n,kind}=message;if(kind==="ended")this.say(message.messages.map(each=>({tone:kind,...each})));if(kind==="followed")this.takeFollowed(message);else if(this.flying.
has(n))this.followRefused(message);else if(n===this.placing?.n)this.takePlaced(message);else if(n===this.solving?.n||kind==="cancelled"&&this.solving&&n>this.solving.
n)this.takeSolving(message)}takeFollowed(frame){const asked=this.flying.get(frame.n);if(!asked)return;const{document:document2,isOld}=asked,from=frame.from??(isOld?
null:this.basis);this.flying.delete(frame.n);if(this.pending&&from===this.pending.n)this.install(this.pending);this.goOn(document2);const isThere=document2===this.
solvedFor&&!this.followed;if(from===this.basis&&!isThere){this.followed=frame;this.followedFor=document2;this.emit("followed")}if(!this.flying.size&&![this.followedFor,
this.solvedFor].includes(this.document))this.follow()}goOn(document2){const asked=[document2,...[...this.flying.values()].map(each=>each.document)];if(!asked.includes(
this.document))this.follow()}followRefused({n,kind,messages=[],solve=false,whole=false}){const{document:document2}=this.flying.get(n);this.flying.delete(n);if(kind===
"refused"&&!solve)this.say(messages);if(whole)this.whole=kindOf(document2);this.goOn(document2)}takePlaced(message){const{pivots}=this.placing;this.placing=null;
if(this.placeWanted&&message.kind==="placed"){this.placed={...message,pivots};this.emit("placed")}else if(message.kind==="refused"){this.say(message.messages)}if(this.
placeWanted&&this.placeWanted!==pivots)this.sendPlace()}takeSolving(message){const{document:document2}=this.solving,isNow=document2===this.document,isAnother=this.
solvedTask!==this.task;if(message.kind==="progress"||message.kind==="waiting"){const before=`waiting for ${message.before} other${message.before===1?"":"s"}`;if(isNow)
this.setState("solving",message.kind==="progress"?message.text:before);return}if(message.kind==="solving")return;this.solving=null;if(message.kind==="solved"){const answer={
...message,document:document2};if(isNow||!this.canFollow)this.install(answer);else this.pending=answer}else if(isAnother){this.forget("There is no answer to thi\
s task yet")}if(message.kind==="refused"){this.say(message.messages)}else if(!["solved","ended"].includes(message.kind)){const[said]=[message.message].flat();this.
say([{tone:message.kind,...typeof said==="string"?{message:said}:said}])}if(isNow)this.setState("resting","")}get isEmpty(){return this.document.poses.length<FEWEST}forget(message=NO_ANSWER.
outcome.message){if(!this.solved)return;const result={...this.solved,...NO_ANSWER,outcome:{message},space:{...this.solved.space,quadrics:[]}};this.install({n:null,
result,document:this.document,seconds:null,was:void 0});if(this.placed)this.place([])}install({n,result,document:document2,seconds,was}){const told=Object.entries(
was??{});this.renamed=new Map(told.map(([now,{id}])=>[id,now]));this.moved=new Map(told.map(([now,{moved}])=>[now,moved]));if(!told.length&&document2===this.solvedFor&&
!this.followed)for(const{id}of result.linkages)this.renamed.set(id,id);const carried=id=>id===PLACED2&&this.placed?.linkage?id:this.renamed.get(id)??null;this.isAnother=
this.solvedTask!==this.task;this.solved=result;this.solvedFor=document2;this.solvedTask=this.task;this.seconds=seconds;this.basis=n;this.whole=null;this.pending=
null;this.followed=null;this.followedFor=null;for(const each of this.flying.values())each.isOld=true;this.chosen=carried(this.chosen)??result.linkages[0]?.id??null;
this.compared=carried(this.compared);this.pinned=new Set([...this.pinned].map(carried).filter(Boolean));this.messages=[];this.emit("solved","chosen","pinned","m\
essages");if(document2!==this.document)this.follow()}takeCognate(linkage,of){this.placeWanted=null;this.placed={linkage,dyads:[],pivots:[],cost:null,messages:[],
cognateOf:of};this.chosen=PLACED2;this.emit("placed","chosen")}letCognateGo(){const{cognateOf}=this.placed;this.placed=null;if(this.chosen===PLACED2)this.chosen=
cognateOf;this.emit("placed","chosen")}opened(){this.flying.clear();this.solving=this.placing=null;this.setState("resting","");this.basis=null;this.solve()}closed(){
clearTimeout(this.resting);this.flying.clear();this.solving=this.placing=null;this.setState("offline","")}setState(state,progress=""){if(state===this.state&&progress===
this.progress)return;this.state=state;this.progress=progress;this.emit("state")}say(messages){this.messages=messages;this.emit("messages")}choose(id){if(id===this.
chosen)return;this.chosen=id;this.emit("chosen");if(this.state==="dragging"||this.document!==this.solvedFor)this.follow()}pin(id){if(!this.pinned.delete(id))this.
pinned.add(id);this.emit("pinned")}compare(id){this.compared=id===this.compared?null:id;this.emit("chosen")}select(selection){if(selection?.kind===this.selection?.
kind&&selection?.index===this.selection?.index)return;this.selection=selection;this.emit("selection")}};var MOST3=40;var Results=class{constructor(store,answers){this.store=store;this.answers=answers;this.cards=new Map;this.wanted={order:"rank",filter:"all",type:""};
this.all=false;const choice=(name,entries,key)=>h("label",{},`${name} `,h("select",{"data-choice":key,onchange:event=>this.want(key,event.target.value)},entries.
map(([value,text])=>h("option",{value},text))));this.types=choice("Type",[["","any"]],"type");this.title=h("h2",{},"Linkages");this.status=h("p",{class:"bs-resu\
lts-status",role:"status"});this.doubt=h("p",{class:"bs-doubt"});this.gone=h("p",{class:"bs-gone-note"});this.list=h("div",{class:"bs-cards"});this.more=h("butt\
on",{type:"button",class:"bs-small",hidden:true,onclick:()=>this.showAll()});this.element=h("section",{class:"bs-results","aria-label":"Linkages"},h("div",{class:"\
bs-results-head"},this.title,this.status,this.doubt,this.gone,h("div",{class:"bs-choices"},choice("Show",Object.entries(FILTERS).map(([key,{name}])=>[key,name]),
"filter"),choice("Sort by",Object.entries(ORDERS).map(([key,{name}])=>[key,name]),"order"),this.types)),this.list,this.more);this.pace=new Pace(()=>this.update());
this.list.addEventListener("keydown",event=>this.walk(event));answers.on("answers placed",()=>this.arrange());answers.on("moved",()=>this.pace.ask());answers.on(
"shown",()=>this.update());store.on("pinned",()=>this.arrange());store.on("state document",()=>this.tell());this.arrange()}want(key,value){this.wanted[key]=value;
this.arrange()}showAll(){this.all=true;this.arrange()}arrange(){const{answers,store,wanted}=this;this.buildTypes();const every=arranged(answers.linkages,{...wanted,
pinned:store.pinned});const shown2=this.all?every:every.slice(0,MOST3);const list=answers.placed?[answers.placed,...shown2]:shown2;const cards=new Map;for(const linkage of list)
cards.set(linkage,this.cards.get(linkage)??this.card());for(const[linkage,card]of this.cards)if(!cards.has(linkage))card.element.remove();this.cards=cards;let before=null;
for(const card of cards.values()){const next=before?before.nextSibling:this.list.firstChild;if(card.element!==next)this.list.insertBefore(card.element,next);before=
card.element}give(this.more,"hidden",every.length<=shown2.length);if(!this.more.hidden)say(this.more,`Show all ${every.length}`);this.hidden=answers.linkages.length-
every.length;this.update()}card(){const{store}=this;return new ResultCard({choose:id=>store.choose(id),pin:id=>store.pin(id),compare:id=>store.compare(id),improve:id=>this.
improve(id),letGo:()=>this.letGo()})}letGo(){if(this.store.placed?.cognateOf)this.store.letCognateGo();else this.store.place([]);if(this.store.chosen===PLACED)this.
store.choose(this.answers.linkages[0]?.id??null)}buildTypes(){const types=[...new Set(this.answers.linkages.map(each=>each.type))].sort(),key=types.join();const select=this.
types.querySelector("select");if(key===this.typesKey)return;this.typesKey=key;if(!types.includes(this.wanted.type))this.wanted.type="";select.replaceChildren(...[
"",...types].map(type=>h("option",{value:type,selected:type===this.wanted.type},type||"any")));give(this.types,"hidden",types.length<2)}update(){const{answers,store}=this,
{data,isOld,shown:shown2}=answers;for(const[linkage,card]of this.cards){card.show(linkage,{data,old:isOld&&linkage.id!==PLACED,chosen:linkage===shown2,pinned:store.
pinned.has(linkage.id),compared:store.compared===linkage.id})}this.tell()}tell(){const{answers,store}=this,there=answers.linkages.filter(each=>!each.gone);const usable=there.
filter(each=>each.usable).length;say(this.title,there.length?`${there.length} linkage${there.length===1?"":"s"}, ${usable} usable`:store.solved?"No linkage":"Li\
nkages");put(this.status,"aria-live",store.state==="dragging"?"off":"polite");say(this.status,this.statusText());const uncertain=store.followed?.uncertain??[];say(
this.doubt,store.followed&&answers.isOld?uncertain.length?`May change when you let go: ${uncertain[0]}${/[.!]$/.test(uncertain[0])?"":"."}`:store.followed.complete===
false?"A linkage that appears now is seen when you let go.":"":"");say(this.gone,!answers.isOld&&answers.gone.length?`Not in the new answer: ${listed(answers.gone)}\
 of the one before.`:"");this.element.classList.toggle("bs-stale",answers.isOld)}statusText(){const{store,answers}=this,hidden=this.hidden?`${this.hidden} not s\
hown by the filter. `:"";if(store.state==="offline")return"The connection is gone; what you see is the last answer.";if(answers.isOld&&store.state==="dragging")
return store.followed?"Moving along.":this.whenSolved();if(store.state==="solving")return"Looking for all linkages.";if(!store.solved)return"";const{best,outcome}=store.
solved;if(!store.solved.linkages.some(each=>each.usable))return`${hidden}${sentence(outcome?.message)}${outcome?.help?` What helps: ${outcome.help}.`:""}`;return`${hidden}${best?.[0]??
""}`}whenSolved(){const{slow}=this.store;if(slow===null)return"The new answer comes when you let go.";const took=`All linkages are looked for anew, which took ${slow<
.95?"less than a second":`${Math.round(slow)} s`} last time`;return slow>QUICK?`${took}: the new answer comes when you let go.`:`${took}: the answer lags behind\
 your hand by so much.`}async improve(id){const{document:document2,options,connection}=this.store;const card=()=>[...this.cards].find(([linkage])=>linkage.id===
id)?.[1];card()?.tellBetter(["Looking near it …"]);let said;try{said=(await(await connection.post("/improve",{document:document2,options,linkage:id})).json()).
better}catch(error){said=[`That did not work: ${error.message}`]}if(document2===this.store.document)card()?.tellBetter(said.length?said.map(nearIt):["Nothing be\
tter lies near it."])}walk(event){const step={ArrowDown:1,ArrowRight:1,ArrowUp:-1,ArrowLeft:-1}[event.key];const mains=[...this.cards.values()].map(card=>card.main),
at=mains.indexOf(this.list.getRootNode().activeElement);if(!step||at<0)return;event.preventDefault();mains[clamp(at+step,0,mains.length-1)].focus()}};var nearIt=text=>text.
replace(/^L\d+ changes/,"One changes");var sentence=text=>text?`${text[0].toUpperCase()}${text.slice(1)}.`:"";var WAY=["x","y","angle","drive","transmission"];var POSE=["x","y","angle_deg","position","turned_deg","transmission_deg"];function decodeFrame(buffer){const length=new DataView(
buffer).getUint32(0,true);const header=JSON.parse(new TextDecoder().decode(new Uint8Array(buffer,4,length)));const numbers=floats(buffer,4+length);for(const linkage of header.
linkages??[]){if(linkage.ways)linkage.ways=linkage.ways.map(way=>({...way,...pieces(numbers,way,WAY)}));if(!linkage.poses)continue;const{count}=linkage.poses;const columns=pieces(
numbers,linkage.poses,POSE);linkage.pose_errors=Array.from({length:count},(_,pose)=>{const at=linkage.at?.[pose]??null;const row={way:at?at[0]:null,frame:at?at[1]:
null};for(const name of POSE){const value=columns[name][pose];row[name]=Number.isNaN(value)?null:value}return row})}return header}function floats(buffer,start){
if(new Uint8Array(new Uint16Array([1]).buffer)[0]===1)return new Float32Array(buffer,start);const view=new DataView(buffer,start);return Float32Array.from({length:view.
byteLength/4},(_,k)=>view.getFloat32(4*k,true))}function pieces(numbers,{start,count},names){return Object.fromEntries(names.map((name,k)=>[name,numbers.subarray(
start+k*count,start+(k+1)*count)]))}var PATIENCE=1500;var Kernel=class{constructor(model){this.model=model;this.view=Math.random().toString(36).slice(2);this.listeners={message:[],open:[],closed:[],
told:[],busy:[]};this.n=0;this.waiting=null;this.heard=(message,buffers)=>this.take(message,buffers);model.on("msg:custom",this.heard)}on(name,fn){this.listeners[name].
push(fn)}emit(name,value){for(const fn of this.listeners[name])fn(value)}take(message,buffers=[]){if(message.view!==null&&message.view!==this.view)return;this.rest();
if(message.n===void 0)this.emit("told",message);else this.emit("message",message.kind==="followed"?decodeFrame(bytesOf(buffers[0])):message)}send(message){this.
n+=1;if(message.do!=="choose")this.waiting??=setTimeout(()=>this.emit("busy",true),PATIENCE);this.model.send({view:this.view,n:this.n,...message});return this.n}rest(){
clearTimeout(this.waiting);this.waiting=null;this.emit("busy",false)}close(){clearTimeout(this.waiting);this.model.off("msg:custom",this.heard)}};function bytesOf(data){
return data instanceof ArrayBuffer?data:data.buffer.slice(data.byteOffset,data.byteOffset+data.byteLength)}var notebook_default="/* The widget of a notebook; in a shadow root, after widget.css and studio.css. */\n\n:host { display: block; }\n.bm.bn { min-height: 0; font\
-size: 14px; border: 1px solid var(--bm-line); border-radius: 8px; overflow: hidden; background: var(--bm-panel); }\n.bn-main { display: grid; height: 470px; gri\
d-template-columns: minmax(0, 1fr) 236px; }\n.bn-left { display: grid; gap: 5px; padding: 7px 10px 8px; min-width: 0; min-height: 0; grid-template: auto minmax(0\
, 1fr) auto / minmax(0, 1fr); }\n.bn-bar { display: flex; gap: 5px; align-items: center; min-width: 0; }\n.bs .bn-bar .bm-button { min-height: 28px; min-width: 30\
px; padding: 1px 8px; font-size: 0.82rem; }\n.bm .bn-line { flex: 1; min-width: 0; min-height: 2.6em; max-height: 2.6em; overflow: auto; display: flex; align-ite\
ms: center; margin-left: 5px; font-size: 0.78rem; line-height: 1.3; color: var(--bm-muted); }\n.bm .bn-line.bn-refused { color: var(--bm-bad); }\n.bn .bs-plane { \
height: auto; min-height: 0; }\n.bn .bs-scene { touch-action: pan-y; }\n.bn .bs-origin, .bn .bs-turn, .bn .bs-corner, .bn .bs-middle { touch-action: none; }\n.bn .\
bs-player { gap: 0; }\n.bn .bs-player .bm-row { gap: 4px 8px; }\n.bn .bm-now { font-size: 0.76rem; }\n.bn .bs-driver-note { display: none; }\n.bn-ways { font-size: \
0.78rem; }\n.bn-ways summary { cursor: pointer; color: var(--bm-accent); width: fit-content; }\n.bs.bn .bm-controls { gap: 3px; margin: 0; }\n.bs.bn .bm-controls .\
bm-button { min-height: 28px; padding: 1px 10px; font-size: 0.82rem; }\n.bn .bm-controls, .bn .bm-row { font-size: 0.82rem; }\n.bn .bs-results { padding: 8px 8px \
8px 10px; min-height: 0; align-content: start; grid-template-rows: auto minmax(0, 1fr); gap: 6px; border-left: 1px solid var(--bm-line); background: var(--bm-bg\
); }\n.bn .bs-results .bs-choices, .bn .bs-card-tools, .bn .bs-better { display: none; }\n.bm.bn .bs-results-status { font-size: 0.76rem; max-height: 6.2em; overf\
low: auto; }\n.bn .bs-cards { grid-template-columns: minmax(0, 1fr); overflow: auto; scrollbar-width: thin; padding: 1px; }\n.bn .bs-card { font-size: 0.8rem; }\n.\
bn .bs-card-main { padding-bottom: 9px; }\n.bn .bs-card .bm-choice-head { font-size: 0.88rem; }\n.bn .bs-figures, .bs.bn .bs-card-note, .bs.bn .bm-reason, .bs.bn \
.bs-help { font-size: 0.77rem; }\n.bn .bm-whole { font-size: 0.8rem; }\n.bn .bs-figures dd { white-space: nowrap; }\n.bn .bs-gone-note { display: none; }\n@containe\
r (max-width: 559px) {\n  .bn-main { height: auto; grid-template-columns: minmax(0, 1fr); }\n  .bn-bar { flex-wrap: wrap; }\n  .bm .bn-line { flex-basis: 100%; mar\
gin-left: 0; max-height: 4em; }\n  .bn .bs-plane { height: 270px; }\n  .bn .bs-results { border-left: 0; border-top: 1px solid var(--bm-line); }\n  .bn .bs-cards {\
 display: flex; align-items: stretch; overflow-x: auto; padding-bottom: 5px; }\n  .bn .bs-card.bm-choice { flex: 0 0 212px; }\n}\n/* What changes under a hand is l\
aid out by itself. */\n.bn { contain: layout style paint; }\n.bn .bs-player, .bn .bs-results, .bn-bar { contain: layout style; }\n";var DARK_SCHEME="(prefers-color-scheme: dark)";var REM=16;var LATE=400;function dress(root,texts,signal){const sheets=texts.map(text=>{const sheet=new CSSStyleSheet;
sheet.replaceSync(text.replace(/([\d.]+)rem\b/g,(_,size2)=>`${REM*size2}px`));return sheet});const dark=sheets.flatMap(({cssRules})=>[...cssRules]).filter(rule=>rule.
media?.mediaText===DARK_SCHEME);const follow2=()=>{const on=isDark(root.host);for(const rule of dark)rule.media.mediaText=on?"all":"not all";root.host.style.colorScheme=
on?"dark":"light"};const both=()=>{follow2();setTimeout(follow2,LATE)};const seen2=new MutationObserver(both);for(const element of[document.documentElement,document.
body])seen2.observe(element,{attributes:true});matchMedia(DARK_SCHEME).addEventListener("change",both,{signal});const placed=new ResizeObserver(follow2);placed.
observe(root.host);signal.addEventListener("abort",()=>[seen2,placed].forEach(each=>each.disconnect()));root.adoptedStyleSheets=sheets;both()}function isDark(element){
for(let node=element;node;node=node.parentElement??node.getRootNode().host){const colour=getComputedStyle(node).backgroundColor;const[r,g,b,a=1]=colour.startsWith(
"rgb")?(colour.match(/[\d.]+/g)??[]).map(Number):[0,0,0,0];if(a>.5)return .299*r+.587*g+.114*b<128}return matchMedia(DARK_SCHEME).matches}var MOST_FLYING2=2;var PATIENCE2=700;var BUSY="The kernel is busy: what is done here is answered when it is free.";var HINT="Drag a pose by its point, turn it b\
y the tip of its arrow.";var ROOM3="Drag poses by their points, turn them by the tips of their arrows; limits, regions and the body are dragged, too.";function render({
model,el}){const ended=new AbortController,{signal}=ended,kernel=new Kernel(model);const host=h("div",{}),frame=h("div",{class:"bm bs bn"},h("p",{class:"bn-line"},
"Waiting for the kernel…"));host.attachShadow({mode:"open"}).append(frame);el.replaceChildren(host);dress(host.shadowRoot,[widget_default,studio_default,notebook_default],
signal);keepKeys(host);let studio=null;kernel.on("message",message=>{if(message.kind==="opened"&&!studio)studio=layOut(frame,kernel,message,turn)});kernel.on("t\
old",message=>{if(message.kind==="task"&&message.by!==kernel.view)studio?.replace(message.document);else if(message.kind==="chosen"&&message.id)studio?.store.choose(
message.id)});const turn=()=>{model.set("turn",model.get("turn")+1);model.save_changes()};kernel.send({do:"open"});return()=>{ended.abort();kernel.close();studio?.
playing.player.play(false);el.replaceChildren()}}function layOut(frame,kernel,{document:task},turn){const store=new Store({connection:kernel,document:task,mostFlying:MOST_FLYING2});
const scene=new Scene(store,{zoomKey:true}),answers=new Answers(store),playing=new Playing(store,answers);new LiveLinkage(answers,playing,scene);new BodyEditor(
store,scene);new Regions(store,scene);new PoseHandles(store,scene);const results=new Results(store,answers),left=h("div",{class:"bn-left"},bar(store,scene,kernel),
scene.element,playing.element);const ways=playing.element.querySelector(".bs-player-ways"),fold=h("details",{class:"bn-ways"},h("summary",{},"Driver and assembl\
y"));ways.replaceWith(fold);fold.append(ways);frame.replaceChildren(h("div",{class:"bn-main"},left,results.element));scene.resize();const refit=fitOnceSolved(store,
scene);listenToKeys(store,scene,null,frame);listenToSpace(playing,frame);playOnce(store,answers,playing);store.on("chosen",()=>{kernel.send({do:"choose",id:store.
chosen,basis:store.basis});turn()});kernel.emit("open");const replace=document2=>{if(JSON.stringify(document2)!==JSON.stringify(store.document)){store.replace({
document:document2});refit()}else if(store.solvedFor===store.document){return}store.solve()};return{store,playing,replace}}function bar(store,scene,kernel){const undo=button(
"↶",()=>store.undo(),{"data-do":"undo",title:"Undo (Ctrl+Z)","aria-label":"Undo"});const redo=button("↷",()=>store.redo(),{"data-do":"redo",title:"Redo (Ctr\
l+Shift+Z)","aria-label":"Redo"});const stop=button("Stop",()=>store.cancel(),{"data-do":"cancel",title:"Stop solving",hidden:true});const pose=button("Add pose\
s",()=>scene.use(scene.tool?null:new PoseTool(store,scene)),{"data-do":"add-poses","aria-pressed":"false"});const line=h("p",{class:"bn-line",role:"status"});let isBusy=false;
const show=()=>{give(undo,"disabled",!store.history.canUndo);give(redo,"disabled",!store.history.canRedo);const[said]=store.messages,solving=store.state==="solv\
ing"&&store.progress;put(pose,"aria-pressed",Boolean(scene.tool));const text=isBusy?BUSY:said?[said.message,said.help].filter(Boolean).join("; "):scene.tool?scene.
tool.hint:solving?`Solving: ${store.progress}`:hint(store.document);if(line.textContent!==text)line.textContent=text;line.classList.toggle("bn-refused",Boolean(
said))};kernel.on("busy",on=>{if(on===isBusy)return;isBusy=on;show()});let waiting;store.on("state",()=>{clearTimeout(waiting);if(store.state==="solving")waiting=
setTimeout(()=>give(stop,"hidden",false),PATIENCE2);else give(stop,"hidden",true)});store.on("document state messages solved",show);scene.on("tool",show);show();
return h("div",{class:"bn-bar"},undo,redo,pose,button("Fit",()=>scene.fitAgain(),{"data-do":"fit",title:"Show all poses and pivots (0)"}),stop,line)}function hint(document2){
return limitRegions(document2).length||regionsOf(document2).length||bodyOf(document2).length?ROOM3:HINT}function fitOnceSolved(store,scene){let waits=true;store.
on("solved",()=>{if(waits&&scene.isFitted)scene.fit();waits=false});return()=>waits=true}function keepKeys(host){host.addEventListener("keydown",event=>{if(!(event.
ctrlKey||event.metaKey)||/^[zy]$/i.test(event.key))event.stopPropagation()})}var notebook_default2={render};export{notebook_default2 as default};
