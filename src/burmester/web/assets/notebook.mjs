// Made by scripts/bundle from src/burmester/web/notebook: change those files, not this one.
var Ks=`/* The studio's page.  Colours and type are those of widget.css. */

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
.bs-head { display: flex; gap: 8px; align-items: center; padding: 5px 10px; border-bottom: 1px solid var(--bm-line); background: var(--bm-panel); min-width: 0; }
.bm .bs-head h1 { font-size: 0.92rem; white-space: nowrap; padding-right: 4px; }
.bs-head .bs-task-name { width: 11rem; font-weight: 600; flex: 0 1 auto; }
.bs-head .bs-row { flex-wrap: nowrap; gap: 4px; }
.bs .bs-head .bm-button { white-space: nowrap; }
.bs [data-menu="export"] > summary { background: var(--bm-accent); border-color: var(--bm-accent); color: var(--bm-panel); font-weight: 600; }
.bs [data-menu="export"] > summary::after { color: inherit; }
.bs-unseen { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; white-space: nowrap; }
.bm .bs-status { flex: 1 1 6rem; min-width: 0; text-align: right; color: var(--bm-muted); font-size: 0.88rem; min-height: 1.5em; white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
.bs-row, .bs-tools { display: flex; flex-wrap: wrap; gap: 6px 10px; align-items: center; }
.bs .bm-button { min-height: 32px; padding: 3px 10px; font-size: 0.86rem; }
.bs .bm-button[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); box-shadow: inset 0 -3px 0 var(--bm-accent); }
.bs-tools .bm-button { min-height: 28px; padding: 1px 8px; font-size: 0.82rem; }

.bs-menu { position: relative; }
.bs-menu > summary { list-style: none; }
.bs-menu > summary::-webkit-details-marker { display: none; }
.bs-menu > summary::after { content: "▾"; color: var(--bm-muted); }
.bs-menu-list { position: absolute; z-index: 20; top: calc(100% + 4px); left: 0; min-width: 260px; max-width: min(440px, 86vw); max-height: 70vh; overflow: auto; display: grid; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 10px; padding: 5px; box-shadow: 0 8px 28px rgb(0 0 0 / 0.18); }
.bs-menu-list { overscroll-behavior: contain; }
.bm .bs-menu-heading { color: var(--bm-muted); font-size: 0.78rem; font-weight: 650; padding: 6px 10px 2px; }
.bs-menu .bs-exports { left: auto; right: 0; width: min(640px, calc(100vw - 16px)); max-width: none; max-height: calc(100dvh - 70px); gap: 8px; }
.bs-uses { display: grid; grid-template-columns: repeat(auto-fill, minmax(190px, 1fr)); gap: 2px 8px; align-items: start; }
.bs-uses > div { display: grid; }
.bs-exports .bs-section { padding: 4px 10px; border: 0; border-top: 1px solid var(--bm-line); }
.bs-menu-item { font: inherit; font-size: 0.88rem; color: inherit; background: none; border: 0; border-radius: 6px; padding: 6px 10px; text-align: left; cursor: pointer; display: grid; }
.bs-menu-item:hover, .bs-menu-item:focus-visible { background: var(--bm-wash); }
.bs-menu-item b { font-weight: 600; }
.bs-menu-item span { color: var(--bm-muted); font-size: 0.8rem; }

.bs-banners { position: fixed; z-index: 30; left: 10px; bottom: 10px; width: min(272px, calc(100vw - 20px)); max-height: 46vh; overflow: auto; display: grid; gap: 8px; }
.bs-banner { position: relative; box-shadow: 0 6px 24px rgb(0 0 0 / 0.16); background: var(--bm-panel); border: 1px solid var(--bm-line); border-left: 4px solid var(--bm-accent); border-radius: 8px; padding: 8px 46px 8px 14px; display: grid; gap: 6px; overflow-wrap: anywhere; }
.bs-banner.bs-refused, .bs-banner.bs-limit, .bs-banner.bs-offline, .bs-banner.bs-expired { border-left-color: var(--bm-bad); }
.bm .bs-banner-title { font-weight: 600; }
.bm .bs-banner ul { list-style: none; display: grid; gap: 6px; }
.bs-where, .bs-why { color: var(--bm-muted); }
.bs-where { margin: 2px 0; font: 12px/1.4 ui-monospace, Menlo, Consolas, monospace; white-space: pre-wrap; overflow-wrap: anywhere; }
.bs .bs-banner .bs-close { position: absolute; top: 5px; right: 6px; border: 0; background: none; font: inherit; color: var(--bm-muted); width: 32px; height: 32px; cursor: pointer; border-radius: 6px; }
.bs .bs-banner .bs-close:hover { background: var(--bm-faint); }

.bs-main { display: grid; min-height: 0; grid-template: minmax(0, 1fr) auto / auto minmax(0, 1fr) auto; grid-template-areas: "left stage right" "left drawer right"; }
.bs-side { position: relative; min-width: 0; min-height: 0; overflow: auto; overscroll-behavior: contain; scrollbar-width: thin; padding: 8px 12px 24px; background: var(--bm-bg); scroll-padding-bottom: 24px; }
/* Messages stand under the panel. */
.bs-side-left { margin-bottom: var(--bs-banners, 0); grid-area: left; width: clamp(292px, 18vw, 460px); border-right: 1px solid var(--bm-line); }
.bs-side-right { grid-area: right; width: clamp(288px, 19vw, 620px); border-left: 1px solid var(--bm-line); }
.bs .bs-fold { position: absolute; top: 6px; right: 6px; z-index: 2; border: 0; background: none; color: var(--bm-muted); font: inherit; font-size: 0.82rem; min-width: 26px; min-height: 26px; border-radius: 6px; cursor: pointer; padding: 2px 4px; }
.bs-fold:hover { background: var(--bm-faint); }
.bs-fold-name { display: none; }
.bs-side.bs-folded { width: 34px; padding: 6px 3px; overflow: hidden; }
.bs-folded > :not(.bs-fold) { display: none; }
.bs .bs-folded > .bs-fold { position: static; display: grid; gap: 8px; justify-items: center; width: 100%; }
.bs-folded .bs-fold-name { display: block; writing-mode: vertical-rl; }
.bs-left { display: grid; gap: 6px; min-width: 0; grid-template-columns: minmax(0, 1fr); }
.bs .bm-card { padding: 12px 14px; }
.bs-stage { grid-area: stage; min-width: 0; min-height: 0; display: grid; grid-template: auto minmax(0, 1fr) auto / minmax(0, 1fr); background: var(--bm-panel); }
.bs-stage > .bs-bar { grid-row: 1; }
.bs-stage > .bs-canvas { grid-row: 2; }
.bs-stage > #bs-player { grid-row: 3; }
.bs-bar { display: flex; gap: 4px; align-items: center; padding: 4px 8px; overflow-x: auto; scrollbar-width: none; border-bottom: 1px solid var(--bm-faint); }
.bs .bs-bar .bm-button { min-height: 28px; padding: 1px 9px; white-space: nowrap; flex: none; border-color: transparent; background: none; }
.bs .bs-bar .bm-button:hover { background: var(--bm-faint); }
.bs .bs-bar .bm-button[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); }
.bs-gap { flex: 1; }
.bs-canvas { position: relative; min-height: 0; min-width: 0; }
/* One line over the plane: nothing moves where it changes, and nothing is caught by it. */
.bm .bs-line { position: absolute; left: 40px; right: 110px; top: 5px; text-align: center; pointer-events: none; color: var(--bm-muted); font-size: 0.82rem; line-height: 1.35; text-shadow: 0 0 3px var(--bm-panel), 0 0 3px var(--bm-panel), 0 0 3px var(--bm-panel); }
#bs-player { min-width: 0; padding: 5px 10px 3px; border-top: 1px solid var(--bm-faint); }
.bs-sheets { display: none; }
.bs-drawer { grid-area: drawer; position: relative; min-width: 0; min-height: 0; display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); height: min(var(--bs-height), 62vh); border-top: 1px solid var(--bm-line); background: var(--bm-bg); }
.bs-drawer.bs-closed { height: auto; }
.bs-grip { position: absolute; left: 0; right: 0; top: -5px; height: 10px; cursor: ns-resize; touch-action: none; z-index: 3; }
.bs-grip::after { content: ""; position: absolute; left: 50%; top: 3px; width: 44px; height: 4px; margin-left: -22px; border-radius: 2px; background: var(--bm-line); }
.bs-grip:hover::after, .bs-grip:focus-visible::after { background: var(--bm-accent); }
.bs-tabs { display: flex; gap: 2px; overflow-x: auto; scrollbar-width: none; padding: 3px 8px; }
.bs-tab, .bs-sheet { font: inherit; font-size: 0.84rem; color: var(--bm-muted); background: none; border: 0; border-radius: 6px; min-height: 28px; padding: 2px 10px; white-space: nowrap; cursor: pointer; flex: none; }
.bs-tab:hover, .bs-sheet:hover { background: var(--bm-faint); }
.bs-tab[aria-selected="true"], .bs .bs-sheet[aria-pressed="true"] { color: var(--bm-ink); font-weight: 650; box-shadow: inset 0 -2px 0 var(--bm-accent); border-radius: 6px 6px 0 0; }
.bs-drawer-panels { min-height: 0; overflow: auto; overscroll-behavior: contain; scrollbar-width: thin; }
.bs-closed .bs-drawer-panels { display: none; }
.bs-panel { padding: 6px 12px 12px; }
/* Beside the words a map or a space is as high as the drawer. */
.bs-panel-space > div, .bs-panel-pivots .bs-surface { display: grid; gap: 4px 16px; grid-template-columns: minmax(180px, 1fr) minmax(0, calc(1.2 * (var(--bs-height) - 60px))); align-content: start; }
.bs-panel-space .bm-fill, .bs-panel-pivots .bs-surface .bm-fill { grid-column: 2; grid-row: 1 / span 9; margin: 0; }
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
.bm .bs-pose-name { font-weight: 600; fill: var(--bm-muted); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; pointer-events: none; unicode-bidi: plaintext; }
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
.bm .bs-region-name, .bm .bs-limit-name { font-size: 11.5px; fill: var(--bm-muted); paint-order: stroke; stroke: var(--bm-panel); stroke-width: 3px; unicode-bidi: plaintext; }
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
.bs-index { font: inherit; font-size: 0.82rem; width: 100%; min-height: 28px; color: var(--bm-muted); background: none; border: 1px solid transparent; border-radius: 6px; cursor: pointer; padding: 0; }
.bs-index:hover { border-color: var(--bm-line); }
.bs-index[aria-pressed="true"] { color: var(--bm-accent); font-weight: 700; }
.bs-field { display: inline-grid; min-width: 0; width: 100%; }
.bs-number, .bs-text { width: 100%; min-width: 0; min-height: 28px; padding: 2px 6px; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; }
.bs .bs-number { text-align: right; }
.bs-poses .bs-number, .bs-poses .bs-text { border-color: transparent; background: none; }
.bs-poses tr:hover .bs-number, .bs-poses tr:hover .bs-text, .bs-poses tr.bs-selected .bs-number, .bs-poses tr.bs-selected .bs-text { border-color: var(--bm-line); }
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

.bs-dropping { position: fixed; inset: 0; z-index: 50; display: grid; place-items: center; background: color-mix(in srgb, var(--bm-bg) 82%, transparent); border: 4px dashed var(--bm-accent); font-size: 1.2rem; font-weight: 600; pointer-events: none; }
.bs-dialog { background: var(--bm-panel); color: var(--bm-ink); border: 1px solid var(--bm-line); border-radius: 12px; padding: 18px 20px; max-width: min(760px, 92vw); max-height: 86vh; overflow: auto; }
.bs-dialog::backdrop { background: rgb(0 0 0 / 0.45); }
.bs-keys { display: grid; gap: 5px; padding: 10px 0; }
.bs-keys div { display: grid; grid-template-columns: minmax(6rem, 11rem) 1fr; gap: 12px; }
.bs-keys dt { font-weight: 600; }
.bs-command { display: grid; gap: 4px; padding: 8px 0; justify-items: start; }
.bs-command pre { margin: 0; width: 100%; overflow-x: auto; background: var(--bm-faint); border-radius: 6px; padding: 8px 10px; font: 13px/1.45 ui-monospace, "SF Mono", Menlo, Consolas, monospace; white-space: pre-wrap; overflow-wrap: anywhere; }
.bs-qr { width: min(280px, 70vw); display: block; }

@media (pointer: coarse) {
  .bs .bm-button, .bs-number, .bs-text, .bs-choice, .bs-tick, .bs-index { min-height: 40px; }
  .bs-tools .bm-button { min-height: 38px; padding: 3px 12px; }
  .bs-hold { r: 22px; }
  .bs-corner { r: 9px; }
  .bs-middle { r: 8px; }
}
@media (max-width: 1179px) {
  .bs-main { grid-template: minmax(0, 1fr) auto / minmax(0, 1fr) auto; grid-template-areas: "stage side" "drawer side"; }
  .bs-sheets { display: flex; grid-area: side; align-self: start; gap: 2px; padding: 4px 8px; background: var(--bm-bg); border-left: 1px solid var(--bm-line); z-index: 4; }
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
  .bm .bs-line { left: 40px; right: 90px; top: 3px; font-size: 0.74rem; white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
  .bs-bar { padding: 2px 4px; }
}
@media print {
  body.bs { height: auto; overflow: visible; }
  .bs-skip, .bs-head > :not(h1, .bs-task-name), .bs-banners, .bs-bar, .bs-line, .bs-tools, .bs-tabs, .bs-sheets, .bs-grip, .bs-fold, .bs-details, .bs .bm-button, .bs-section:not([open]) { display: none !important; }
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
.bs-small { font: inherit; font-size: 0.8rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; min-height: 26px; padding: 1px 9px; cursor: pointer; }
.bs-small:hover { border-color: var(--bm-muted); }
.bs-small[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); }
.bs-tool { display: flex; flex-wrap: wrap; gap: 4px 10px; align-items: center; font-size: 0.86rem; margin-top: 6px; }
.bs-tool label { display: inline-flex; gap: 6px; align-items: center; cursor: pointer; min-height: 26px; }
.bs-tool input { accent-color: var(--bm-accent); margin: 0; }
.bm .bs-points { list-style: none; width: 100%; display: grid; gap: 4px; }

.bs-chips { display: grid; gap: 5px; padding: 0 0 8px; }
.bs-chips > :first-child { padding-right: 22px; }
.bs-chips-of { color: var(--bm-muted); font-size: 0.78rem; align-self: center; }
.bm .bs-chip-list { list-style: none; display: flex; flex-wrap: wrap; gap: 4px; }
.bs-chip { display: inline-flex; max-width: 100%; border: 1px solid var(--bm-line); border-radius: 13px; background: var(--bm-panel); font-size: 0.78rem; line-height: 1.3; }
.bs-chip > * { font: inherit; color: inherit; background: none; border: 0; border-radius: 13px; padding: 3px 9px; min-height: 26px; text-align: left; display: inline-flex; align-items: center; overflow-wrap: anywhere; }
.bs-chip > button { cursor: pointer; }
.bs-chip > button:hover { background: var(--bm-faint); }
.bs-chip > [aria-expanded="true"] { background: var(--bm-wash); }
.bs-chip > .bs-chip-remove { padding: 3px 8px 3px 3px; color: var(--bm-muted); }
.bs-chip.bs-met { border-color: var(--bm-good); }
.bs-chip.bs-broken { border: 2px solid var(--bm-bad); color: var(--bm-bad); }
.bs-chip.bs-assumed { border-style: dashed; color: var(--bm-muted); }
.bs-chip-editor { display: grid; gap: 5px; border-left: 2px solid var(--bm-accent); padding: 4px 0 4px 9px; justify-items: start; font-size: 0.86rem; }
.bs-advice { display: grid; gap: 4px; }
.bs-advised { border-left: 3px solid var(--bm-follower); padding-left: 8px; font-size: 0.82rem; overflow-wrap: anywhere; }
.bs-advised > summary { cursor: pointer; }
.bs-advised > :not(summary) { margin-top: 4px; }
.bs-results { display: grid; gap: 10px; grid-template-columns: minmax(0, 1fr); }
.bs-results-head { display: grid; gap: 4px; }
.bm .bs-results-status, .bm .bs-doubt, .bm .bs-gone-note { font-size: 0.84rem; color: var(--bm-muted); overflow-wrap: anywhere; }
.bm .bs-results-status { min-height: 1.5em; }
.bm .bs-doubt:empty, .bm .bs-gone-note:empty { display: none; }
.bm .bs-doubt { color: var(--bm-bad); }
.bs-choices { display: flex; flex-wrap: wrap; gap: 4px 10px; font-size: 0.82rem; color: var(--bm-muted); }
.bs-choices select { background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 6px; padding: 2px 4px; font-size: 0.82rem; max-width: 9.5em; }
.bs-cards { display: grid; gap: 8px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 240px), 1fr)); align-items: start; }
.bs-card.bm-choice { padding: 0; cursor: default; gap: 0; flex: none; }
.bs-card.bs-chosen { border-color: var(--bm-accent); background: var(--bm-wash); box-shadow: inset 4px 0 0 var(--bm-accent); }
.bs-card-main { font: inherit; color: inherit; text-align: left; background: none; border: 0; padding: 9px 12px 4px; cursor: pointer; display: grid; gap: 2px; border-radius: 10px; min-width: 0; }
.bs .bs-card .bm-reason:not(:empty) { display: block; }
.bs-card:not(.bs-chosen) .bm-reason:not(:empty) { display: -webkit-box; -webkit-box-orient: vertical; -webkit-line-clamp: 3; overflow: hidden; }
.bs-old .bm-portrait { opacity: 0.45; }
.bs-was { color: var(--bm-muted); font-size: 0.78rem; font-weight: 400; }
.bs-card-main dl { font-size: 0.84rem; }
.bs-card-tools { display: flex; flex-wrap: wrap; gap: 5px; padding: 2px 12px 9px; }
.bs-help { border-left: 3px solid var(--bm-accent); padding-left: 7px; }
.bm .bs-better { padding: 0 12px 9px 28px; font-size: 0.82rem; color: var(--bm-muted); }
.bm .bs-better:empty { display: none; }
.bs-old [data-figure="size"], .bs-old [data-figure="sensitivity"], .bs-old .bs-help, tr.bs-old, .bs-facts section.bs-old, .bs-stale .bm-map { opacity: 0.45; }
.bs-card.bs-gone { border-style: dashed; }
.bs-card.bs-gone dl { opacity: 0.45; }

#bs-player .bm-controls { gap: 1px 12px; margin: 0; align-items: center; }
#bs-player .bm-row { gap: 5px; flex-wrap: nowrap; }
#bs-player .bm-more { gap: 2px 10px; flex-wrap: nowrap; }
.bs #bs-player .bm-pick { min-height: 26px; font-size: 0.8rem; width: auto; padding: 0 2px; }
#bs-player .bm-now { font-size: 0.82rem; color: var(--bm-muted); white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
.bs #bs-player .bm-button { min-height: 30px; padding: 1px 9px; font-size: 0.84rem; white-space: nowrap; }
.bs #bs-player .bm-play { min-width: 76px; background: var(--bm-panel); color: var(--bm-accent); border-color: var(--bm-accent); }
#bs-player .bm-whole, #bs-player .bm-real { font-size: 0.82rem; min-height: 26px; }
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
.bs-pivot:focus-visible .bs-hold, .bs-coupler-point:focus-visible .bs-hold { fill: var(--bm-accent); fill-opacity: 0.2; stroke: var(--bm-accent); stroke-width: 2; }
.bs-map-pivot { pointer-events: none; }
.bs-map-pivot .bs-pivot-ring { fill: var(--bm-panel); fill-opacity: 0.6; stroke: var(--bm-ink); stroke-width: 2.4; stroke-dasharray: none; }
.bs-curve { fill: none; stroke-width: 2.4; }
.bs-curve-M { stroke-dasharray: 5 4; }
.bs-curve-plain { stroke: var(--bm-muted); }
.bs-curve-works { stroke: var(--bm-good); }
.bs-curve-outside { stroke: var(--bm-pair-outside); }
.bs-curve-fails { stroke: var(--bm-bad); opacity: 0.55; stroke-width: 1.6; }
.bs-key-works, .bs-key-outside, .bs-key-fails { display: inline-block; width: 18px; height: 4px; border-radius: 2px; vertical-align: 3px; background: var(--bm-good); }
.bs-key-outside { background: var(--bm-pair-outside); }
.bs-key-fails { background: var(--bm-bad); }
.bs-placed-readout { display: block; font-size: 0.86rem; margin-top: 4px; overflow-wrap: anywhere; }
.bs-placed-readout:empty { display: none; }

.bs-panel .bs-surface .bm-map svg { touch-action: none; }
.bs-compare { border: 1px solid var(--bm-accent); border-radius: 10px; padding: 9px 10px; background: var(--bm-panel); }
.bs-compare[hidden] { display: none; }
.bs-compare table { font-size: 0.8rem; }
.bs-beside { display: grid; gap: 8px; grid-template-columns: repeat(auto-fit, minmax(min(100%, 170px), 1fr)); }
.bs-beside h3 { font-size: 0.86rem; margin: 0; }
.bs-filters { display: flex; flex-wrap: wrap; gap: 4px 6px; }
.bs-filter { font: inherit; font-size: 0.8rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 999px; min-height: 26px; padding: 1px 10px; cursor: pointer; }
.bs-filter:hover { border-color: var(--bm-muted); }
.bs-filter[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); }
.bm .bs-compared { table-layout: fixed; }
.bm .bs-compared th { white-space: normal; }
.bm .bs-compared th, .bm .bs-compared td { text-align: left; }
.bs-facts { display: grid; gap: 16px; grid-template-columns: minmax(0, 1fr); }
.bs-facts caption { position: static; width: auto; height: auto; clip-path: none; text-align: left; color: var(--bm-muted); padding: 2px 0; }
@media (max-width: 759px) {
  #bs-player .bm-controls { grid-template-columns: minmax(0, 1fr); }
  #bs-player .bm-more { justify-content: flex-start; }
    #bs-player .bm-now { white-space: normal; max-height: 2.8em; font-size: 0.76rem; line-height: 1.35; }
  .bs-cards { grid-template-columns: repeat(auto-fill, minmax(min(100%, 220px), 1fr)); }
}
@media (forced-colors: active) {
  .bs-chosen, .bs .bm-button[aria-pressed="true"], .bs-tab[aria-selected="true"], .bs .bs-sheet[aria-pressed="true"], .bs-pose-row.bs-selected { outline: 3px solid Highlight; outline-offset: -3px; }
  .bs-scene, .bs-map-pivot, .bm-map { forced-color-adjust: none; }
}
@media (pointer: coarse) { .bs-small { min-height: 38px; padding: 3px 12px; } }
@media print {
  .bs-card-tools, .bs-choices, .bs-tool, .bs-results-status, .bs-pivots, .bs-player .bm-row, .bs-player .bm-more, .bs-player .bm-track { display: none !important; }
  .bs-panel { break-inside: avoid; margin-bottom: 6mm; }
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
.bs-handle-field { position: absolute; z-index: 3; display: flex; gap: 6px; padding: 4px 6px; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 8px; box-shadow: 0 3px 12px rgb(0 0 0 / 0.16); }
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

.bs-load-point { cursor: move; }
.bs-load-mark { fill: var(--bm-panel); stroke: var(--bm-spring); stroke-width: 1.8; }
.bs-load-centre .bs-load-mark { fill: var(--bm-muted); fill-rule: evenodd; stroke: var(--bm-muted); }
.bs-load-hand .bs-load-mark { stroke: var(--bm-hand); }
.bs-load-arrow { fill: none; stroke: var(--bm-bad); stroke-width: 2.2; pointer-events: none; }
.bs-load-leader { fill: none; stroke: var(--bm-muted); stroke-dasharray: 2 3; pointer-events: none; }
.bs-load-point:hover .bs-load-mark { stroke-width: 2.8; }
.bs .bs-load-point:focus-visible { outline: none; }
.bs-load-point:focus-visible .bs-hold { fill: var(--bm-accent); fill-opacity: 0.2; stroke: var(--bm-accent); stroke-width: 2; }
.bs-load-rows, .bs-found-springs { display: grid; gap: 8px; }
.bm .bs-found-springs { list-style: none; }
.bs-loads > h4 { margin: 10px 0 4px; }
.bs textarea.bs-text { font: inherit; font-size: 0.88rem; color: inherit; }
.bs-loads .bs-limit-box { justify-items: stretch; }
.bs-loads .bs-text { width: 100%; box-sizing: border-box; }
.bm .bs-load-notes { list-style: none; font-size: 0.86rem; display: grid; gap: 2px; }
.bs-load-notes.bs-old { opacity: 0.55; }
.bs-backdrop { position: absolute; left: 0; top: 0; transform-origin: 0 0; max-width: none; pointer-events: none; }
.bs-backdrop[hidden] { display: none; }
.bs-plane > .bs-scene { position: relative; }
.bs-section[data-section="transform"] > div, .bs-section[data-section="picture"] > div, .bs-section[data-section="picture"] > div > div { display: grid; gap: 6px; justify-items: start; }
.bs-section > div > [hidden], .bs-section > div > div > [hidden] { display: none; }
.bs-grid .bs-labelled > input[type="file"], .bs-grid .bs-labelled > .bs-text { flex: 1 1 8em; width: 0; min-width: 0; }
.bs-found-springs .bm-button { white-space: normal; text-align: left; }
/* Functions of angles: a page over the page. */
.bs-function { width: 100vw; height: 100dvh; max-width: none; max-height: none; margin: 0; padding: 0; border: 0; background: var(--bm-bg); color: var(--bm-ink); }
.bs-function[open] { display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); }
.bs-function .bs-head { flex-wrap: wrap; }
.bs-function .bs-head h2 { margin: 0; font-size: 0.92rem; padding-right: 4px; }
.bs-function .bs-head .bs-choice { width: auto; flex: 0 1 8rem; min-width: 0; }
.bs-function-close { margin-left: auto; }
.bs-function-main { display: grid; grid-template-columns: 300px minmax(0, 1fr); min-height: 0; }
.bs-function-form { overflow: auto; padding: 10px 12px; display: grid; gap: 8px; align-content: start; border-right: 1px solid var(--bm-line); }
.bs-function-form textarea { width: 100%; font-variant-numeric: tabular-nums; }
.bs-function-report { overflow: auto; container-type: inline-size; }
.bs-function-report.bs-stale { opacity: 0.5; }
.bs-draggable [data-dot] { cursor: ns-resize; r: 5; touch-action: none; }
@media (max-width: 760px) {
  .bs-function-main { display: block; overflow: auto; }
  .bs-function-form { border-right: 0; border-bottom: 1px solid var(--bm-line); }
}
`;var qs=`.bm {
  --bm-bg: #f6f6f3; --bm-panel: #ffffff; --bm-ink: #1a1e25; --bm-muted: #5c6470; --bm-line: #dfe1dd; --bm-faint: #eeefec;
  --bm-driver: #1b5cb8; --bm-follower: #a84a12; --bm-coupler: #4a5869; --bm-plate: #d5dce4;
  --bm-driver-solid: #5b93dd; --bm-follower-solid: #e09b62;
  --bm-wanted: #6c7580; --bm-error: #b0125f; --bm-good: #196b3c; --bm-bad: #9c3118; --bm-accent: #1b5cb8; --bm-wash: #eaf1fb;
  --bm-map-near: #5d9c8f; --bm-map-far: #f7f6ee; --bm-body: #1c7a6c; --bm-spring: #6b43ab; --bm-hand: #9a5a00;
  --bm-pair-low: #123570; --bm-pair-middle: #7b7b78; --bm-pair-high: #fde737;
  --bm-pair-outside: #9fb4c7; --bm-pair-order: #d9bfa3; --bm-pair-branch: #dfe2e6; --bm-pair-circuit: #f6f6f4;
  container-type: inline-size; background: var(--bm-bg); color: var(--bm-ink); font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; min-height: 100vh;
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
.bm-sign { flex: none; width: 1.45em; height: 1.45em; border-radius: 50%; display: inline-grid; place-items: center; font-size: 0.8em; font-weight: 700; color: var(--bm-panel); background: currentColor; }
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
.bm-choices { display: flex; align-items: flex-start; gap: 10px; overflow-x: auto; padding: 3px 3px 10px; margin: -3px; scroll-snap-type: x proximity; scrollbar-width: thin; }
.bm-choice { flex: 0 0 250px; scroll-snap-align: start; display: flex; flex-direction: column; gap: 3px; text-align: left; font: inherit; font-size: 0.86rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 10px; padding: 10px 12px; cursor: pointer; }
.bm-choice:hover { border-color: var(--bm-muted); }
.bm-choice[aria-pressed="true"] { border-color: var(--bm-accent); background: var(--bm-wash); box-shadow: inset 4px 0 0 var(--bm-accent); }
.bm-choice-head { font-size: 1rem; }
.bm-choice-head b { font-weight: 700; }
.bm-choice span:empty { display: none; }
.bm-portrait { display: block; width: 100%; height: auto; border-radius: 6px; background: var(--bm-panel); overflow: hidden; }
.bm-portrait-last { opacity: 0.3; }
.bm-portrait-pose { fill: var(--bm-error); stroke: none; }
.bm-differs { color: var(--bm-muted); font-size: 0.82rem; }
.bm-verdict { font-weight: 600; }
.bm-quiet, .bm-lengths { color: var(--bm-muted); font-size: 0.78rem; }
.bm-good .bm-verdict { color: var(--bm-good); }
.bm-bad .bm-verdict { color: var(--bm-bad); }
.bm-choice dl div { display: flex; justify-content: space-between; gap: 0 5px; font-size: 0.82rem; }
.bm-choice dt { color: var(--bm-muted); }
.bm-choice dd { text-align: right; }
.bm-whole-word { display: inline-block; white-space: pre; }
.bm-reason, .bm-story, .bm-outcome, .bm-best, .bm-now { overflow-wrap: anywhere; }
.bm-reason { color: var(--bm-muted); font-size: 0.82rem; line-height: 1.38; border-top: 1px solid var(--bm-line); padding-top: 5px; margin-top: 3px; }

.bm .bm-ways { border: 0; display: flex; flex-wrap: wrap; gap: 6px 8px; margin: 0 0 8px; align-items: center; font-size: 0.86rem; }
.bm-ways legend { float: left; padding: 0; margin-right: 6px; color: var(--bm-muted); line-height: 30px; }
.bm-ways label { position: relative; display: inline-flex; align-items: center; gap: 7px; border: 1px solid var(--bm-line); border-radius: 8px; padding: 4px 11px 4px 9px; cursor: pointer; }
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

.bm-controls { display: grid; grid-template-columns: auto minmax(0, 1fr); gap: 6px 12px; margin: 0 0 10px; }
.bm-track, .bm-now { grid-column: 1 / -1; }
.bm-more { display: flex; flex-wrap: wrap; gap: 4px 12px; align-items: center; justify-content: flex-end; }
.bm-row { display: flex; flex-wrap: wrap; gap: 8px; align-items: flex-start; }
.bm-button { font: inherit; font-size: 0.9rem; color: inherit; background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 8px; padding: 5px 11px; min-height: 34px; cursor: pointer; display: inline-flex; gap: 7px; align-items: center; white-space: nowrap; }
.bm-button:hover { border-color: var(--bm-muted); }
.bm-button:disabled { opacity: 0.45; cursor: default; }
.bm-play { background: var(--bm-accent); border-color: var(--bm-accent); color: var(--bm-panel); min-width: 92px; justify-content: center; font-weight: 600; }
.bm-play svg { fill: currentColor; }
.bm .bm-more select { max-width: 9.5em; }
.bm-whole, .bm-real { display: inline-flex; gap: 6px; align-items: center; min-height: 34px; font-size: 0.9rem; white-space: nowrap; cursor: pointer; }
.bm-whole input, .bm-real input, .bm-far-pivots input, .bm-close-up input { accent-color: var(--bm-accent); margin: 0; }
.bm-whole:has(:disabled) { opacity: 0.45; cursor: default; }
.bm-real[hidden] { display: none; }
.bm-small-step { padding: 5px 9px; }
.bm-pick { font: inherit; font-size: 0.86rem; color: var(--bm-ink); background: var(--bm-panel); border: 1px solid var(--bm-line); border-radius: 8px; min-height: 34px; padding: 2px 4px; }
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
.bm-proved > ul { padding-left: 18px; }
.bm-scroll { overflow-x: auto; margin-top: 8px; scrollbar-width: thin; }
.bm table { border-collapse: collapse; width: 100%; font-size: 0.86rem; }
.bm caption { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
.bm-dimensions caption, .bm-every caption { position: static; width: auto; height: auto; clip-path: none; text-align: left; font-weight: 600; padding: 6px 0 2px; }
.bm th, .bm td { text-align: right; padding: 3px 12px 3px 0; border-bottom: 1px solid var(--bm-faint); vertical-align: top; white-space: nowrap; font-weight: 400; }
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
.bm-pair-scale { display: inline-block; width: 64px; height: 11px; border: 1px solid var(--bm-muted); border-radius: 2px; vertical-align: -1px; background: linear-gradient(to right, var(--bm-pair-low), var(--bm-pair-middle), var(--bm-pair-high)); }
.bm-pair-key { white-space: nowrap; margin-right: 8px; }
.bm-pair-outside { background: var(--bm-pair-outside); }
.bm-pair-order { background: var(--bm-pair-order); }
.bm-pair-branch { background: var(--bm-pair-branch); }
.bm-pair-circuit { background: var(--bm-pair-circuit); }
.bm-readout { display: block; }
.bm-legend, .bm-readout { font-size: 0.82rem; color: var(--bm-muted); }
.bm .bm-legend { margin-top: 8px; }
.bm-swatch { display: inline-block; width: 14px; height: 11px; border: 1px solid var(--bm-muted); border-radius: 2px; vertical-align: -1px; margin-right: 3px; }
.bm-swatch.bm-far { margin-left: 12px; }
.bm-near { background: var(--bm-map-near); }
.bm-far { background: var(--bm-map-far); }

.bm-space { position: relative; border: 1px solid var(--bm-faint); border-radius: 8px; touch-action: pan-y; cursor: grab; user-select: none; -webkit-user-select: none; }
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
  .bm-choice .bm-reason, .bm-choice .bm-lengths, .bm-choice .bm-differs { display: none; }
  .bm-choice .bm-portrait { height: 120px; }
}
@container (max-width: 640px) {
  .bm-controls { grid-template-columns: minmax(0, 1fr); }
  .bm-more { justify-content: flex-start; }
  .bm-card { padding: 12px 12px 14px; }
  .bm .bm-dimensions { font-size: 0.8rem; }
  .bm .bm-dimensions td, .bm .bm-dimensions th { padding-right: 6px; }
  .bm .bm-dimensions td:last-child { padding-right: 0; }
  .bm .bm-named tbody th { white-space: normal; min-width: 7rem; max-width: 9rem; overflow-wrap: break-word; }
  .bm .bm-stacks, .bm .bm-stacks tbody { display: block; }
  .bm .bm-stacks thead { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; }
  .bm .bm-stacks tr { display: block; padding: 6px 0; border-bottom: 1px solid var(--bm-line); }
  .bm .bm-stacks tbody th, .bm .bm-stacks td { display: flex; justify-content: space-between; gap: 14px; border: 0; padding: 1px 0; white-space: normal; text-align: right; min-width: 0; }
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
  .bm-body:has(.bm-list) { grid-template-columns: 264px minmax(0, 1fr); }
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
    --bm-wanted: #6c7580; --bm-error: #b0125f; --bm-good: #196b3c; --bm-bad: #9c3118; --bm-wash: #fff; --bm-body: #1c7a6c; --bm-spring: #6b43ab; --bm-hand: #9a5a00;
    font-size: 10pt; min-height: 0; }
  .bm-list, .bm-row, .bm-more, .bm-track, .bm-factor, .bm-ways, .bm-every summary, .bm-about summary, .bm-readout { display: none !important; }
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
`;var E=(i,t,e)=>Math.min(Math.max(i,t),e),J=i=>i*180/Math.PI,S=i=>i*Math.PI/180,x=i=>Math.abs(i)<1e7?+i.toFixed(5):Math.sign(i)*1e7;function N(i,t){if(i==null||!Number.isFinite(i))return"–";let e=i.toFixed(t);return Number(e)===0?e.replace("-",""):e}function q(i){if(i===null||!Number.isFinite(i))return"–";if(i===0)return"0";if(Math.abs(i)>=99.5&&Math.abs(i)<1e6)return i.toFixed(0);let t=i.toExponential(1),[e,s]=t.split("e").map(Number);return s>=-4&&s<2?String(Number(t)):s>0?`${e}e${s}`:`${e}e-${String(-s).padStart(2,"0")}`}function ut(i,t,e){let s=(t-i)/Math.max(1,e),n=10**Math.floor(Math.log10(s)),o=[1,2,5,10].map(l=>l*n).find(l=>l>=s*.999)??10*n,r=Math.max(0,-Math.floor(Math.log10(o*1.0001))),a=[];for(let l=Math.ceil(i/o-1e-9);l*o<=t+o*1e-9;l+=1)a.push({at:l*o,text:N(l*o,r)});return a}function Ye(i){return i.length<2?i.join(""):`${i.slice(0,-1).join(", ")} and ${i[i.length-1]}`}function Xs(i,t){let e=[];for(let s=0;s<i.length;){let n=s;for(;n+1<i.length&&i[n+1]===i[n]+1;)n+=1;if(n-s>=2)e.push(`${t[i[s]-1]}–${t[i[n]-1]}`);else for(let o=s;o<=n;o+=1)e.push(t[i[o]-1]);s=n+1}return Ye(e)}var to="http://www.w3.org/2000/svg";function Hs(i,t,e){for(let[s,n]of Object.entries(t??{}))n==null||n===!1||(s.startsWith("on")?i.addEventListener(s.slice(2),n):i.setAttribute(s,n===!0?"":n));return i.append(...e.flat(1/0).filter(s=>s!=null)),i}var u=(i,t,...e)=>Hs(document.createElement(i),t,e),b=(i,t,...e)=>Hs(document.createElementNS(to,i),t,e);function f(i,t,e){let s=String(e);i.getAttribute(t)!==s&&i.setAttribute(t,s)}function O(i,t,e){let s=typeof i[t]=="boolean"?!!e:String(e);i[t]!==s&&(i[t]=s)}function _(i,t){let e=String(t);i.textContent!==e&&(i.textContent=e)}var Nt=i=>E(4-Math.ceil(Math.log10(i.scene)),0,12),Ke=i=>i.label===i.name?i.name:`${i.label}: ${i.name}`,Xt=i=>i.angle_deg===null,Ht=({poses:i,stop:t=void 0})=>t??(i.length&&i.every(Xt)?"point":"pose");var Ut=i=>i.called??`${Xt(i)?"point":"pose"} ${Ke(i)}`,dt=(i,t)=>i.length>t?`${i.slice(0,t-1).trimEnd()}…`:i;function Us(i,t,e){if(i==="-")return"–";let[s,...n]=i.split(" ("),o=[s==="exact"?s:`${s}${e}`,...n].join(" (");return t==="free"||i==="exact"&&t==="exact"?o:`${o} and ${t}`}function Gs(i,t){let e=new Set(t.ways.map(n=>n.circuit)).size,s=[];return(e>1||i.branches<2)&&s.push(`assembly ${i.circuit}`),i.branches>1&&s.push(`branch ${i.branch}`),s.join(", ")}function L(i,t){let e={...i,...t};for(let[s,n]of Object.entries(t))n===void 0&&delete e[s];return e}var He=(i,t,e)=>i.map((s,n)=>n===t?e:s),Xe=(i,t)=>i.filter((e,s)=>s!==t),Zs=(i,t,e)=>[...i.slice(0,t),e,...i.slice(t)],Zt=(i,t,e)=>L(i,{[t]:e.length?e:void 0}),Ue=i=>Object.keys(i).length?i:void 0,eo={x:0,y:0,angle_deg:0},so=10,io=(i,t)=>!!i?.free?.includes(t)||i?.tolerance?.[t]==="free",st=i=>io(i,"angle"),no=({poses:i})=>i.length>0&&i.every(st),Tt=i=>no(i)&&(i.path!==void 0||i.poses.length>=so),oo=(i,t)=>L(i,{path:L(i.path??{closed:!1},t)});var ro=i=>i&&["x","y","angle_deg"].every(t=>!i[t]);function Vs(i){let{poses:t,path:e,tolerance:s}=i,n=t.some(o=>o.free?.length);return L(i,{path:e&&t.length&&!t.every(st)?void 0:e,tolerance:n?s??eo:ro(s)?void 0:s})}var Js=(i,t)=>i.path?.crank_deg?oo(i,{crank_deg:t(i.path.crank_deg)}):i;function ao(i,t){let[e,s]=[i[t-1],i[t]];return e!==void 0&&s!==void 0?(e+s)/2:e===void 0?(s??0)-10:e+(e-(i[t-2]??e-10))}var Ge=(i,t,e)=>L(i,{poses:He(i.poses,t,L(i.poses[t],e))}),Qs=(i,t,e=i.poses.length)=>Vs(Js(L(i,{poses:Zs(i.poses,e,t)}),s=>Zs(s,e,ao(s,e)))),lo=(i,t)=>Vs(Js(L(i,{poses:Xe(i.poses,t)}),e=>Xe(e,
t))),ti=(i,t)=>[...t].sort((e,s)=>s-e).reduce(lo,i);var Vt=(i,t)=>Zt(i,"body",t),Z=i=>Array.isArray(i.body)?i.body:[],j=i=>i.keep_out===void 0?[]:[i.keep_out].flat(),ei=(i,t)=>Zt(i,"keep_out",[...j(i),t]),si=(i,t,e)=>Zt(i,"keep_out",He(j(i),t,L(j(i)[t],e))),ii=(i,t)=>Zt(i,"keep_out",Xe(j(i),t));var it=i=>i.limits===void 0?[]:[i.limits].flat(),ho=["fixed_pivot","moving_pivot","rail through","rail travel","slot through","slot travel"],nt=i=>i==="moving_pivot"||i.startsWith("slot"),Gt=(i,t)=>t.split(" ").reduce((e,s)=>e?.[s],i),po=(i,t)=>Object.entries(t).reduce((e,[s,n])=>{let[o,r]=s.split(" ");return L(e,{[o]:r?Ue(L(e[o]??{},{[r]:n})):n})},i);function Jt(i,t,e){let s=it(i),n=po(s[t]??{},e),o=t<s.length?He(s,t,n):[...s,n],r=o.length>1||Ue(n)?o:[];return L(i,{limits:r.length>1?r:r[0]})}var X=i=>it(i).flatMap((t,e)=>ho.filter(s=>Gt(t,s)).map(s=>{let[[n,o]]=Object.entries(Gt(t,s));return{table:e,key:s,shape:n,points:n==="point"?[o]:o}})),Qt=(i,t)=>({[i]:i==="point"?t[0]:t}),te=(i,t,e)=>L(i,{requirements:Ue(L(i.requirements??{},{[t]:e}))});function qe(i,t,e){if(Number.isFinite(i[t][e]))return i[t][e];let s=i.slice(0,t).findLastIndex(a=>Number.isFinite(a[e])),n=i.slice(t+1).findIndex(a=>Number.isFinite(a[e]))+t+1,[o,r]=[i[s]?.[e],n>t?i[n][e]:void 0];return o===void 0||r===void 0?o??r??0:o+(t-s)/(n-s)*(r-o)}function A({poses:i},t){let{x:e,y:s,angle:n}=i[t];return Number.isFinite(
e)&&Number.isFinite(s)&&Number.isFinite(n)?{x:e,y:s,angle:n}:{x:qe(i,t,"x"),y:qe(i,t,"y"),angle:qe(i,t,"angle")}}var V=({poses:i},t)=>(i[t]?.name??String(t+1)).replace(/[\r\n\u2028\u2029]+/g," "),ni=(i,t)=>Object.fromEntries(Object.entries(t).filter(([e])=>Number.isFinite(i[e])));var gt=class{heard;on(t,e){this.heard??=new Map;for(let s of t.split(" "))this.heard.set(s,[...this.heard.get(s)??[],e])}emit(t,...e){for(let s of this.heard?.get(t)??[])s(...e)}};function $(i,[t,e]){let s=Math.cos(i.a),n=Math.sin(i.a);return[i.x+s*t-n*e,i.y+n*t+s*e]}function pt(i,[t,e]){let s=Math.cos(i.a),n=Math.sin(i.a);return[s*(t-i.x)+n*(e-i.y),-n*(t-i.x)+s*(e-i.y)]}var D=i=>{let t=S(i.line.normal_deg);return[Math.cos(t),Math.sin(t)]};function oi(i,t){if(i.kind==="PP"){let a=t.a-S(i.angle_deg);return[a-2*Math.PI*Math.round(a/(2*Math.PI)),0,0,1]}if(i.kind==="RP"){let[a,l]=D(i),h=Math.cos(t.a),d=Math.sin(t.a),p=h*a-d*l,c=d*a+h*l,m=i.fixed_pivot[0]-t.x,g=i.fixed_pivot[1]-t.y;return[p*m+c*g-i.line.offset,-p,-c,p*g-c*m]}let[e,s]=$(t,i.moving_pivot),n,o,r;if(i.kind==="RR"){
let a=e-i.fixed_pivot[0],l=s-i.fixed_pivot[1],h=Math.hypot(a,l)||1;[n,o,r]=[a/h,l/h,h-i.radius]}else[n,o]=D(i),r=n*e+o*s-i.line.offset;return[r,n,o,(e-t.x)*o-(s-t.y)*n]}function co(i,t,e){let{x:s,y:n,a:o}=t;for(let r=0;r<4;r+=1){let[a,...l]=oi(i[0],{x:s,y:n,a:o}),[h,...d]=oi(i[1],{x:s,y:n,a:o});l[2]/=e,d[2]/=e;let p=l[0]*l[0]+l[1]*l[1]+l[2]*l[2],c=l[0]*d[0]+l[1]*d[1]+l[2]*d[2],m=d[0]*d[0]+d[1]*d[1]+d[2]*d[2],g=p*m-c*c;if(!(g>1e-9*p*m))return{x:s,y:n,a:o};let w=(a*m-h*c)/g,k=(h*p-a*c)/g;if(s-=w*l[0]+k*d[0],n-=w*l[1]+k*d[1],o-=(w*l[2]+k*d[2])/e,Math.abs(a)+Math.abs(h)<1e-14*e)break}return{x:s,y:n,a:o}}function Ze(i,t,e,s){let n=i.length-1,o=d=>{if(d>=0&&d<=n)return i[d];if(!s)return d<0?2*i[0]-i[-d]:2*i[n]-i[2*n-d];let p=d<0?d+n:d-n;return i[p]+(d<0?-1:1)*(i[n]-
i[0])},[r,a,l,h]=[o(t-1),o(t),o(t+1),o(t+2)];return a+e/2*(l-r+e*(2*r-5*a+4*l-h+e*(3*(a-l)+h-r)))}function W(i,t,e,s){if(t.joints)return mo(i,t,t.joints,e);let n=i.pose_errors.find(l=>l.at===t&&Math.abs(l.frame-e)<1e-6);if(n)return{x:n.x,y:n.y,a:S(n.angle_deg)};let o=E(Math.floor(e),0,t.x.length-2),r=e-o,a={x:Ze(t.x,o,r,t.round),y:Ze(t.y,o,r,t.round),a:Ze(t.angle,o,r,t.round)};return co(i.led,a,s)}function mo({ground:i},t,e,s){let n=r=>ee(r,s),o={...i};for(let[r,[a,l]]of Object.entries(e))o[r]=[n(a),n(l)];return{x:n(t.x),y:n(t.y),a:n(t.angle),joints:o}}function ee(i,t){let e=Math.min(6,i.length),
s=E(Math.floor(t)-2,0,i.length-e),n=0;for(let o=0;o<e;o+=1){let r=1;for(let a=0;a<e;a+=1)a!==o&&(r*=(t-s-a)/(o-a));n+=r*i[s+o]}return n}function Q(i,t){let e=E(Math.floor(t),0,i.length-2),s=t-e,n=i[e],o=i[e+1];if(n===null||o===null)return null;let r=n+s*(o-n);return Number.isNaN(r)?null:r}function Y({x:i,y:t,stems:e=!1},s){if(s===null)return null;let n=i.findIndex(o=>Math.abs(o-s)<1e-6);return n>=0?t[n]:e||!(s>i[0]&&s<i[i.length-1])?null:Q(t,xt(i,s))}function xt(i,t){let e=0,s=i.length-1;if(t<=i[e])return e;if(t>=i[s])return s;for(;s-e>1;){let o=e+s>>1;i[o]<=t?e=o:s=o}let n=i[s]-i[e];return e+
(n>0?(t-i[e])/n:0)}var bo=["loads","springs","drive"],fo=["extension","compression","gas","constant"];var ri={ground_point:["from","ground"],body_point:["to","body"]};var uo=({springs:i=[]})=>[i].flat();var go=i=>bo.some(t=>i[t]!==void 0),xo=({kind:i})=>fo.includes(i);function wo(i,t){let[e,s]=ri[t],n=i[e];return i[t]||!n?{link:s,point:i[t]??[0,0],path:[t]}:{link:n.link??"ground",point:n.point??[0,0],path:[e,"point"]}}var vo=i=>xo(i)?Object.keys(ri):i.kind==="counterweight"?["body_point"]:[],Ve=i=>go(i)?{hand:i.loads?.hand?.at??null,springs:uo(i).map(t=>({kind:t.kind,ends:t.kind==="torsion"?[{link:"joint",point:[0,0]}]:vo(t).map(e=>wo(t,e))}))}:null;var yo=5,di=1e-7,ko=1e-5,pi=1e-6,tt="placed",Mo={poses:[],body:null,keep_out:[],loads:null,scene:1,span:1,unit:null,dyads:[],linkages:[],dyads_title:"Dyads",chart:{origin:[0,0],angle:0,length:1},space:{centre:[0,0,0],half:[1,1,1],quadrics:[]},pivot_map:null,family_map:null,transmission_limit:{deg:40,said:"40°, a usual limit"},keys:[],table:null,best:[],warnings:[],footnotes:""},se=class extends gt{constructor(t){super(),this.store=t,this.data={...Mo},this.linkages=[],this.gone=[],this.byId=new Map,this.others=new Map,this.placed=null,t.on("solved",()=>this.takeSolved()),t.on("followed",()=>this.
takeFollowed()),t.on("document",()=>this.takePoses()),t.on("chosen",()=>this.emit("shown")),t.on("placed",()=>this.takePlaced()),this.takePoses(),t.solved&&this.takeSolved()}get shown(){return this.get(this.store.chosen)??(this.store.chosen===tt?void 0:this.linkages[0])}get(t){return t===tt?this.placed??void 0:this.byId.get(t)??this.others.get(t??"")}get isOld(){return this.store.solvedFor!==this.store.document}takePoses(){let t=hi(this.store.document);Object.assign(this.data,{poses:t,isPath:Tt(this.store.document),loads:Ve(this.store.document),...$o(this.store.document,this.data)}),this.emit(
"poses")}takeSolved(){let{solved:t,document:e}=this.store,s=this.linkages.filter(p=>!p.gone),{renamed:n,moved:o}=this.store,r=new Map([...n].map(([p,c])=>[c,this.byId.get(p)])),{poses:a,body:l,keep_out:h,...d}=t;Object.assign(this.data,{body:l,keep_out:h,...d,poses:hi(e),loads:Ve(e)}),this.gone=this.store.isEmpty||this.store.isAnother?[]:s.filter(p=>!n.has(p.id)).map(p=>p.id),this.byId=new Map,this.linkages=t.linkages.map(p=>{let c=r.get(p.id),m=c??{},g=c&&c.rank!==1/0,w=g&&c.id!==p.id?c.id:null;for(let k of Object.keys(m))delete m[k];return Object.assign(m,li(ai(p)),{was:w,shift:o.get(p.id)??
0,isNew:this.known&&!this.store.isAnother&&!g,followed:!1,gone:null,change:null}),this.byId.set(m.id,m),m}),this.known=!this.store.isEmpty,this.emit("answers")}takeFollowed(){let t=this.store.followed;if(t){for(let e of t.linkages){let s=this.byId.get(e.id);s&&e.fresh===!1||(s||(s=_o(e),this.byId.set(e.id,s),this.linkages.push(s),this.hasNew=!0),Oo(s,e,this.data))}for(let{id:e,message:s}of t.vanished??[]){let n=this.byId.get(e);n&&Object.assign(n,{gone:s,usable:!1})}for(let{id:e,kind:s,message:n}of t.changes??[]){let o=this.byId.get(e);o&&s!=="vanished"&&(o.change=n)}this.hasNew?(this.hasNew=!1,
this.emit("answers")):this.emit("moved")}}takePlaced(){let t=this.store.placed?.linkage,{cognateOf:e}=this.store.placed??{},s=e?`Cognate of ${e}`:"By hand",n=this.placed;this.placed=t?Object.assign(n??{},li(ai(t)),{id:tt,called:s,gone:null,followed:!1}):null,this.emit("placed"),this.store.chosen===tt&&this.emit(n&&t?"moved":"shown")}},ai=i=>({...i,pose_errors:i.pose_errors.map(t=>({...t,at:t.way===null?null:i.ways[t.way]}))}),li=i=>Object.assign(i,{worst:i.position_error.max,least:i.min_transmission_angle_deg.range});function hi({poses:i=[]}){let t=i.map((s,n)=>s.name||String(n+1)),e=t.every(s=>s.
length<=yo);return i.map((s,n)=>({...s,angle_deg:st(s)?null:s.angle,name:t[n],label:e?t[n]:String(n+1)}))}var $o=(i,t)=>({body:Array.isArray(i.body)?i.body:i.body===void 0?null:t.body});function Oo(i,t,e){if(i.usable=t.usable,i.led=t.led,i.worst=t.worst,i.least=t.transmission_deg,i.reason=t.reason,i.followed=!0,i.gone=null,t.type&&(i.type=t.type),!t.ways?.length){i.ways=i.ways??[];return}i.ways=t.ways,i.pose_errors=t.pose_errors.map(s=>({...s,at:s.way===null?null:t.ways[s.way],said:s.x===null?{position:"-",turned:"-",transmission:"-"}:{position:s.position<di*e.scene?"exact":q(s.position),turned:s.
turned_deg<ko?"exact":`${q(s.turned_deg)}°`,transmission:s.transmission_deg===null?"-":`${N(s.transmission_deg,1)}°`}}))}var _o=i=>({id:i.id,type:i.type??"linkage",rank:1/0,dyads:i.led,ways:[],pose_errors:[],isNew:!0,followed:!0,said:{met:"",story:"",facts:[],reasons:[],quality:{},dimensions:[],notes:[],links:null,manifolds:[[],[]],worst:"–",rms:"–",transmission:"-"},space:null,shortcomings:[],defects:[],unmet:[]});function Je(i,t){return i.worst===null||i.worst===void 0?"–":i.followed?i.worst<di*t.scene?"exact":`${q(i.worst)}${t.unit?` ${t.unit}`:""}`:i.said.worst==="-"?"–":i.said.worst===
"exact"?"exact":`${i.said.worst}${t.unit?` ${t.unit}`:""}`}function ci(i,t){let{rms:e}=i.said,s=Je(i,t);return i.followed||!e||e==="-"||e==="exact"?s:`${e} rms, ${s} at most`}function mi(i){return i.followed?i.least===null||i.least===void 0?"–":`${Math.floor(10*i.least+1e-6)/10}°`:i.said.transmission==="-"?"–":i.said.transmission}var zt=26,Rt=[22,14],R=(i,t,e)=>`translate(${x(i)} ${x(t)}) rotate(${x(J(-e))})`;function It(){let i="";for(let t=-2;t<=2;t+=1)i+=`M${5.5*t+3} 16l-6 7`;return b("g",{class:"bm-foot"},b("path",{class:"bm-solid",d:"M0 0L-10 16H10Z"}),b("path",{class:"bm-ground",d:`M-16 16H16${i}`}))}function ot(i){let t=i,e=Math.max(4,.22*i);return`M0 0H${t}m${-e} ${-e/2}l${e} ${e/2}l${-e} ${e/2}M0 0V${-.6*t}`}function ie(i,t){let e="",s="M";for(let[n,o]of i){if(!Number.isFinite(n)||!Number.isFinite(o)){s="M";continue}e+=`${s}${x(t.X(n))} ${x(t.Y(o))}`,s="L"}return e}function bi(i){let t=[...i].sort((n,o)=>n[0]-
o[0]||n[1]-o[1]),e=n=>{let o=[];for(let r of n){for(;o.length>1;){let[a,l]=o.slice(-2);if((l[0]-a[0])*(r[1]-a[1])-(l[1]-a[1])*(r[0]-a[0])>0)break;o.pop()}o.push(r)}return o.slice(0,-1)},s=[...e(t),...e(t.reverse())];return s.length?s:t.slice(0,1)}var Qe=9,fi=.15,ts=.6,ui=6,gi=16,So=62,U=11,Eo=2.25,Po=90,xi=2,ne=[9,4.5];function vi(i,[t,e],[s,n]){let o=Math.hypot(s-t,n-e)||1,r=[-ui*(n-e)/o,ui*(s-t)/o],a=(h,d)=>`${x(t+h*(s-t)+d*r[0])} ${x(e+h*(n-e)+d*r[1])}`;if(i==="constant")return`M${a(0,0)}L${a(1,0)}`;if(i==="gas")return`M${a(0,1)}L${a(ts,1)}L${a(ts,-1)}L${a(0,-1)}ZM${a(ts,0)}L${a(1,0)}`;let l=Array.from({length:2*Qe+1},(h,d)=>a(fi+(1-2*fi)*d/(2*Qe),d%(2*Qe)?d%2?1:-1:0));return`M${[a(0,0),...l,a(1,0)].join("L")}`}function yi(i,[t,e]){return i!=="torsion"?`M${x(t-U)} ${x(e)}a${U} ${U} 0 1 0 ${2*U} 0a${U} ${U} 0 1 0 ${-2*U} 0h${2*U}M${x(
t)} ${x(e-U)}v${2*U}`:`M${Array.from({length:55},(n,o)=>[o/54*U,o/54*2*Math.PI*Eo]).map(([n,o])=>`${x(t+n*Math.cos(o))} ${x(e-n*Math.sin(o))}`).join("L")}`}function ki({loads:i},t){if(!i)return[];let e=i.springs.flatMap(n=>n.ends),s=n=>e.filter(({link:o})=>o===n).map(({point:o})=>o);return[...s("ground"),...t.flatMap(n=>[...s("body"),...i.hand?[i.hand]:[]].map(o=>$(n,o)))]}function wi([i,t],e,s){let n=Math.cos(e),o=-Math.sin(e),r=[i+s*n,t+s*o],a=l=>`${x(r[0]-ne[0]*n-l*ne[1]*o)} ${x(r[1]-ne[0]*o+l*ne[1]*n)}`;return`M${x(i)} ${x(t)}L${r.map(x).join(" ")}M${a(1)}L${r.map(x).join(" ")}L${a(-1)}`}var oe=class{constructor(){
this.springs=b("g",{class:"bm-springs"}),this.hand=b("path",{class:"bm-hand"}),this.forces=b("g",{class:"bm-pin-forces"}),this.group=b("g",{class:"bm-loads"},this.springs,this.hand,this.forces)}shape(t,e,s){this.view=s,this.loads=t.loads??null,this.known=(e.followed?null:e.loads)??null;let n=this.loads?.springs??[];for(;this.springs.children.length>n.length;)this.springs.lastChild?.remove();for(;this.springs.children.length<n.length;)this.springs.append(b("g",{},b("path",{class:"bm-spring"}),b("circle",{class:"bm-spring-end",r:2.6}),b("circle",{class:"bm-spring-end",r:2.6})));n.forEach(({kind:r,
ends:a},l)=>{let[,...h]=this.springs.children[l].children;f(this.springs.children[l],"data-spring",r);for(let d of h)f(d,"visibility",a.length>1?"inherit":"hidden")});let o=this.known?.pins??[];this.greatest=Math.max(0,...o.flatMap(({force:[r,a]})=>r.map((l,h)=>l===null||a[h]===null?0:Math.hypot(l,a[h])))),this.forces.replaceChildren(...o.map(({name:r})=>b("g",{"data-pin":r},b("path",{class:"bm-pin-force"}),b("text",{class:"bm-pin-newtons"}))))}show(t,e){let{loads:s,view:n}=this;if(!s||!n){f(this.hand,"d","");return}s.springs.forEach(({kind:a,ends:l},h)=>{let d=l.map((c,m)=>this.endOf(c,h,m,t,
e)),p=this.springs.children[h];f(p,"visibility",d.every(Boolean)?"inherit":"hidden"),d.every(Boolean)&&(f(p.children[0],"d",d.length>1?vi(a,d[0],d[1]):yi(a,d[0])),d.forEach(([c,m],g)=>{f(p.children[g+1],"cx",x(c)),f(p.children[g+1],"cy",x(m))}))}),(this.known?.pins??[]).forEach((a,l)=>this.showForce(this.forces.children[l],a,e));let o=this.known?.hand,r=o&&e!==null?Y(o,e):null;if(!s.hand||r===null)f(this.hand,"d","");else{let a=Y({x:o.x,y:o.force},e)??0,l=gi+(So-gi)*Math.abs(a);f(this.hand,"d",wi(this.seen($(t,s.hand)),a<0?r+Math.PI:r,l))}}showForce(t,{at:e,force:s},n){let o=n===null?[null]:e.
map(g=>Y(g,n)),[r,a]=n===null?[null,null]:s.map(g=>Y({x:e[0].x,y:g},n)),l=o.every(g=>g!==null)&&r!==null&&a!==null,h=l?Math.hypot(r,a):0,d=this.greatest?Po*h/this.greatest:0;if(f(t,"visibility",d>xi?"inherit":"hidden"),!(d>xi))return;let p=this.seen(o),c=r/h,m=a/h;f(t.children[0],"d",wi(p,Math.atan2(a,r),d)),f(t.children[1],"x",x(p[0]+(d+6)*c)),f(t.children[1],"y",x(p[1]-(d+6)*m+4)),f(t.children[1],"text-anchor",c<-.3?"end":c>.3?"start":"middle"),t.children[1].textContent=`${t.dataset.pin} ${Number(h.toPrecision(3))} N`}seen([t,e]){let{view:s}=this;return s?[s.X(t),s.Y(e)]:[0,0]}endOf({link:t,
point:e},s,n,o,r){if(t==="ground")return this.seen(e);if(t==="body")return this.seen($(o,e));let a=this.known?.moved.find(h=>h.spring===s&&h.end===n),l=a&&r!==null?a.at.map(h=>Y(h,r)):[null];return l.some(h=>h===null)?null:this.seen(l)}};var Ao=.015,Lo=40,No=1e-6;function jt(i,t,e=!1){let s=(i?.ways[t]?.x.length??2)-1,n=i.pose_errors.filter(h=>h.way===t).map(h=>h.frame),o=n.reduce((h,d)=>Math.min(h,d),s),r=n.reduce((h,d)=>Math.max(h,d),0),a=r-o>No,l=n[n.length-1]<n[0]?-1:1;return{...a&&!e?{low:o,high:r}:{low:0,high:s},sense:l,isApart:a}}var es=(i,t,e,s)=>To(i,s,n=>Number.isInteger(n)&&!e.joints?{x:e.x[n],y:e.y[n],a:e.angle[n]}:W(t,e,n,i.chart.length));function To(i,{low:t,high:e},s){let n=[s(t)],o=t,r=a=>{let l=s(a),h=n[n.length-1],d=Math.min(Lo,Math.floor(Math.hypot(l.x-h.x,l.y-h.y)/(Ao*i.scene)));for(let p=1;p<=d;p+=1)n.push(
s(o+p/(d+1)*(a-o)));n.push(l),o=a};for(let a=Math.floor(t)+1;a<e;a+=1)r(a);return r(e),n}function wt({ways:i}){let t=i.map(e=>e.poses.length);return Math.max(0,t.indexOf(Math.max(...t)))}function Mi({time:{x:i,y:t}},e){return t[0]<=t[t.length-1]?Y({x:t,y:i},e):Y({x:[...t].reverse(),y:[...i].reverse()},e)}function ss(i,t){let[e,s]=D(i),[n,o]=i.kind==="PR"?$(t,i.moving_pivot):pt(t,i.fixed_pivot);return e*o-s*n}function ct(i,t){let e=t.map(s=>ss(i,s));return[e.reduce((s,n)=>Math.min(s,n)),e.reduce((s,n)=>Math.max(s,n))]}function mt(i,t){let[e,s]=D(i),{offset:n}=i.line;return[n*e-t*s,n*s+t*e]}var zo=4,Ro=2.5,Io=.75,jo=.25,Co=400,$i=12,G=i=>i.reduce(([t,e,s,n],[o,r])=>Number.isFinite(o+r)?[Math.min(t,o),Math.min(e,r),Math.max(s,o),Math.max(n,r)]:[t,e,s,n],[1/0,1/0,-1/0,-1/0]),re=(i,t)=>i.poses.flatMap((e,s)=>{let n=t?.pose_errors[s],o=n&&n.x!==null?n:e;return o.angle_deg===null?[]:[{x:o.x,y:o.y,a:S(o.angle_deg),k:s}]});function Oi(i){let[t,e,s,n]=G(i.poses.map(r=>[r.x,r.y])),o=(i.body??[]).reduce((r,[a,l])=>Math.max(r,Math.hypot(a,l)),0);return r=>!(Math.hypot(r[0]-(t+s)/2,r[1]-(e+n)/2)<Math.max(zo*i.scene,o))}function _i(i,t){let e=i.led.flatMap(n=>n.fixed_pivot?[n.fixed_pivot]:[]),
s=i.led.flatMap(n=>n.moving_pivot?[n.moving_pivot]:n.kind==="RP"&&t.length?ct(n,t).map(o=>mt(n,o)):[]);return[...e,...t.flatMap(n=>[...s.map(o=>$(n,o)),...Object.values(n.joints??{})])]}function is(i,t,e,{far:s=!1,close:n=!1}={}){let o=Oi(i),r=p=>s||!o(p),a=t?[...t.pose_errors.filter(p=>p.x!==null),...e]:[],l=[...[...i.poses,...a].map(({x:p,y:c})=>[p,c]),...t?[..._i(t,e),...ki(i,e)]:[]],h=e.filter((p,c)=>c%Math.ceil(e.length/Co)===0&&r([p.x,p.y])),d=i.body&&!n?[...re(i,t),...h].flatMap(p=>i.body.map(c=>$(p,c))):[];return[...l.filter(r),...d]}function ns(i,t,e){let s=G([...i,...t]),[n,o,r,a]=G(
i),l=Math.max(r-n,a-o)||1,h=Io*l;return e||!i.length||Math.max(s[2]-s[0],s[3]-s[1])<=Ro*l?s:[Math.max(s[0],n-h),Math.max(s[1],o-h),Math.min(s[2],r+h),Math.min(s[3],a+h)]}function ae(i,t,e,{whole:s=!1,close:n=!1}={}){let o=is(i,t,e,{far:s,close:n}),r=n?[]:i.keep_out.flatMap(h=>h.outline),a=ns(o,r,s||!t),l=jo*i.scene;for(let h of[0,1]){let d=Math.max(0,l-(a[h+2]-a[h]));a[h]-=d/2,a[h+2]+=d/2}return a}function Ct(i,t,e,s){let n=Math.min((t-2*s)/(i[2]-i[0]),(e-2*s)/(i[3]-i[1])),o=t/2-n*(i[0]+i[2])/2,r=e/2+n*(i[1]+i[3])/2;return{scale:n,left:o,top:r,width:t,height:e,X:a=>o+n*a,Y:a=>r-n*a}}function os({
X:i,Y:t,width:e,height:s},n){let o=i(n[0]),r=t(n[1]),a=e/2,l=s/2;if(o>=0&&r>=0&&o<=e&&r<=s)return null;let h=Math.hypot(o-a,r-l),d=(o-a)/h,p=(r-l)/h,c=Math.min((a-$i)/Math.abs(d),(l-$i)/Math.abs(p));return{x:a+c*d,y:l+c*p,angle:Math.atan2(-p,d)}}var Fo=6;var Bo=(i,t,[e,s])=>`M${i.map(n=>`${x(e+t.scale*n[0])} ${x(s-t.scale*n[1])}`).join("L")}Z`,Si=(i,t)=>Bo(i.body,t,[0,0]),Ei=(i,t)=>t<=Fo||i===0||i===t-1;var et=class{timer;constructor(t,e=()=>!0){this.work=t,this.wanted=e,this.free=0,this.timer=null,Do.add(this)}ask(){this.timer!==null||!this.wanted()||(this.timer=setTimeout(()=>this.now(),Math.max(0,this.free-performance.now())))}catchUp(){this.timer!==null&&this.now()}now(){clearTimeout(this.timer),this.timer=null;let t=performance.now();this.work();let e=performance.now();this.free=e+Math.max(250,8*(e-t))}},Pi=new WeakMap;function Ft(i,t){let e=Pi.get(i);return Pi.set(i,t),e?.length!==t.length||t.some((s,n)=>!Object.is(s,e[n]))}var Ni=new WeakMap,Ai=new WeakMap,Li=null;function Ti(i,t){Li??=
new IntersectionObserver(e=>{for(let{target:s,isIntersecting:n}of e)Ni.set(s,n),n&&Ai.get(s)?.()}),Ai.set(i,t),Li.observe(i)}var rs=i=>Wo||Ni.get(i)===!0,Do=new Set,Wo=!1;var le={µm:1e-6,um:1e-6,mm:.001,cm:.01,m:1,in:.0254,inch:.0254,'"':.0254,"″":.0254,ft:.3048,"'":.3048,"′":.3048},Yo={"°":1,deg:1,degree:1,degrees:1,rad:180/Math.PI,mrad:.18/Math.PI},Ko=/^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[+-]?\d+)?)\s*(.*)$/i,qo=12,Xo=1e300,vt=i=>Number(i.toPrecision(qo)),yt=i=>i==null?"":String(i).replace("-","−").replace("e−","e-");function kt(i,{kind:t="number",unit:e="",optional:s=!1,many:n=!1,least:o=-1/0,above:r=-1/0,below:a=1/0,whole:l=!1}={}){let h=i.normalize("NFKC").replace(/[−–]/g,"-").replace(/[\u00a0\u2009\u202f]/g," ").trim(),d={length:e in le?"1\
2.5 or 0.5 in":"12.5",angle:"30 or 0.5 rad",number:"12.5"}[t];if(n&&h){let M=i.split(/[,;]/).map(y=>kt(y,{kind:t,unit:e,least:o,above:r,below:a,whole:l}));return M.find(({fault:y})=>y)??{value:M.map(({value:y})=>y).join(",")}}if(!h)return s?{value:void 0}:{fault:`A number is missing here: write one such as ${d}.`};let p=Ko.exec(h);if(!p)return{fault:`“${i.trim()}” is not a number: write one such as ${d}.`};let c=Number(p[1].replace(",",".")),m=p[2].trim().replace(/^μm$/,"µm"),g=Ho(m,t,e);if(typeof g=="string")return{fault:g};let w=g===1?c:vt(c*g);if(!(Math.abs(w)<=Xo))return{fault:`${i.trim()}\
 is too large a number.`};let k=t==="angle"?"°":t==="length"&&e?` ${e}`:"";return l&&!Number.isInteger(w)?{fault:`This has to be a whole number, such as ${Math.max(1,Math.round(w))}.`}:w<o?{fault:`This may not be less than ${o}${k}.`}:w<=r?{fault:`This must be greater than ${r}${k}.`}:w>=a?{fault:`This must be less than ${a}${k}.`}:{value:w}}function Ho(i,t,e){if(!i||t==="length"&&i===e)return 1;if(t==="number")return`“${i}” is not needed here: write the number alone.`;let s=t==="angle"?Yo:le,n=i in s?i:i.toLowerCase();return Object.hasOwn(s,n)?t==="angle"?s[n]:Object.hasOwn(le,e)?s[n]/le[e]:
`This task has ${e?`the unit ${e}`:"no unit of length"}: write the number alone.`:`“${i}” is not a unit of ${t} known here: write ${t==="angle"?"° or rad":"mm, cm, m, in or ft"}, or the number alone.`}var zi=0,he=class{constructor({label:t,options:e,commit:s,step:n=()=>1,attributes:o={}}){zi+=1,this.options=e,this.commit=s,this.value=void 0,this.drafts=new Map,this.fault=u("p",{class:"bs-fault",id:`bs-fault-${zi}`,hidden:!0}),this.input=u("input",{class:"bs-number",type:"text",inputmode:"text",autocomplete:"off",spellcheck:"false","aria-label":t,...o,onchange:()=>this.read(),oninput:()=>this.fault.hidden||this.read(),onkeydown:r=>this.nudge(r,n())}),this.element=u("span",{class:"bs-field"},this.input,this.fault)}show(t){let e=t!==this.value;if(this.value=t,e||this.fault.hidden){let s=yt(t);
this.input.value!==s&&!(this.isEdited&&!e)&&(this.input.value=s),e&&this.say(null)}}turnTo(t,e){if(t===this.id)return;this.fault.hidden?this.drafts.delete(this.id):this.drafts.set(this.id,this.input.value);let s=this.drafts.get(t);this.id=t,this.value=e,O(this.input,"value",s??yt(e)),this.say(s===void 0?null:kt(s,this.options()).fault??null)}get isEdited(){return document.activeElement===this.input&&this.input.value!==yt(this.value)}read(){let{value:t,fault:e}=kt(this.input.value,this.options());if(this.say(e??null),e)return;let s=t!==this.value,n=this.value;this.value=t;let o=s?this.commit(t):
null;typeof o=="string"?(this.value=n,this.say(o)):this.input.value=yt(this.value)}get typed(){return kt(this.input.value,this.options()).value}nudge(t,e){t.key==="Enter"&&this.read();let s={ArrowUp:1,ArrowDown:-1}[t.key];if(!s||t.ctrlKey||t.metaKey)return;let{value:n,fault:o}=kt(this.input.value,this.options());o||typeof n!="number"||(t.preventDefault(),this.input.value=yt(H(n,s*Bt(t,e))),this.read())}say(t){O(this.fault,"hidden",t===null),_(this.fault,t??""),t===null?(this.input.removeAttribute("aria-invalid"),this.input.removeAttribute("aria-describedby")):(f(this.input,"aria-invalid","true"),
f(this.input,"aria-describedby",this.fault.id))}};var Bt=(i,t)=>t*(i.shiftKey?10:i.altKey?.1:1),H=(i,t)=>Number((i+t).toPrecision(12));var bt=(i,t,e={})=>u("button",{type:"button",class:"bm-button",onclick:t,...e},i);var Mt=[16,20],de=class{what=null;constructor(t,e){this.store=t,this.scene=e,this.element=u("div",{class:"bs-handle-field",role:"group",hidden:!0}),e.element.append(this.element),t.on("document selection",()=>this.draw()),e.on("view",()=>this.draw()),e.svg.addEventListener("pointerdown",s=>e.dragged||s.button===0&&this.close()),e.svg.addEventListener("keydown",s=>this.begin(s)),this.element.addEventListener("keydown",s=>{s.key!=="Escape"&&s.key!=="Enter"||(this.close(),e.svg.focus({preventScroll:!0}),s.stopPropagation())})}open(t){this.what=t,this.fields=t.fields.map(([e,s,n])=>new he({label:`${s}\
 of ${t.name}`,commit:o=>t.set({[e]:o}),options:()=>({kind:n,unit:this.store.document.length_unit,...t.options}),step:()=>n==="angle"?1:this.scene.step,attributes:{"data-key":e,title:s}})),this.element.replaceChildren(...this.fields.map((e,s)=>u("label",{},u("span",{},t.fields[s][1]),e.element))),this.element.setAttribute("aria-label",t.name),O(this.element,"hidden",!1),this.draw()}close(){this.what&&(this.what=null,O(this.element,"hidden",!0))}draw(){let{what:t,store:e,scene:{view:s}}=this,n=t?.kind===e.selection?.kind&&t?.at();if(!n)return this.close();let o=t.values(),r=this.element.offsetWidth,
a=this.element.offsetHeight,[l,h]=[s.X(n[0]),s.Y(n[1])];this.fields.forEach((d,p)=>d.show(o[t.fields[p][0]])),this.element.style.left=`${l+Mt[0]+r>s.width?l-Mt[0]-r:l+Mt[0]}px`,this.element.style.top=`${Math.max(0,h+Mt[1]+a>s.height?h-Mt[1]-a:h+Mt[1])}px`}begin(t){if(!this.what||t.target===this.scene.svg||!/^[\d.,\-−]$/.test(t.key)||t.ctrlKey||t.metaKey||t.altKey)return;let[{input:e}]=this.fields;e.focus(),e.select()}};var Ii=7.2,ji=14,Uo=80,Go=60,Zo=500,Vo=6,Jo=60,Qo=.15,tr=2;function ce(i,t,e,s=!1){let n=(Ii*i.length+4)/2,o=[],r=s?8:16;for(let a=0;a<(s?1:3);a+=1)for(let l=0;l<r;l+=1){let h=(l%2?1:-1)*Math.ceil(l/2)*(2*Math.PI/r),d=t+h,p=e+9*a;o.push([(p+n-5)*Math.cos(d),p*Math.sin(d),3*Math.abs(h)+14*a])}return o}function Ci(i,t){let e=Math.max(0,t/2-30);return[0,-.5,.5,-1,1].flatMap(s=>[[s*e,i,8*Math.abs(s)],[s*e,-i,10+8*Math.abs(s)]])}var pe=class{timer;constructor(t){this.scene=t,this.names=new Map,this.obstacles=[],this.timer=null,t.on("dropped",()=>this.ask())}avoid(t){this.obstacles.push(t)}get areMany(){
return this.names.size>Go}put(t,e,s,n,o,r=!1){let a=this.names.get(t),l={x:e,y:s,text:n,places:o,isLesser:r,at:a?.text===n?a.at:o[0]};this.names.set(t,l),this.show(t,l),this.ask()}ask(){clearTimeout(this.timer),this.scene.dragged||(this.timer=setTimeout(()=>this.place(),Uo))}show(t,{x:e,y:s,at:n}){f(t,"text-anchor","middle"),f(t,"transform",`translate(${x(e+n[0])} ${x(s-n[1]+4)})`)}place(){if(this.scene.dragged)return;for(let a of[...this.names.keys()])a.isConnected||this.names.delete(a);let{width:t,height:e}=this.scene.view,s=[...this.names].filter(([a,{x:l,y:h}])=>l>-20&&h>-20&&l<t+20&&h<e+20&&
a.getAttribute("display")!=="none"),n=this.obstacles.flatMap(a=>a()).map(Fi),o=new Map;for(let a=0;a<(this.areMany?1:2);a+=1)for(let[l,h]of s){o.delete(l);let d=[...o.values()],p={cost:1/0,at:h.at,box:[0,0,0,0]};for(let c of h.places){let m=er(h,c),g=c[0]===h.at[0]&&c[1]===h.at[1]?Vo:0,w=c[2]-g;(m[0]<2||m[1]<2||m[2]>t-2||m[3]>e-2)&&(w+=Zo);for(let M of n)w+=as(m,M);for(let M of d)w+=tr*as(m,M);let k=Ri(m,h);s.some(([,M])=>M!==h&&Ri(m,M)<k+1)&&(w+=Jo),w<p.cost&&(p={cost:w,at:c,box:m})}h.at=p.at,o.set(l,p.box)}let r=s.filter(([,{isLesser:a}])=>!a).map(([a])=>o.get(a));for(let[a,l]of s){let h=o.get(
a),d=l.isLesser&&r.some(p=>as(h,p)>Qo*(h[2]-h[0])*ji);l.isLesser&&!d&&r.push(h),f(a,"visibility",d?"hidden":"visible"),this.show(a,l)}}},Fi=([i,t,e,s])=>[i-e/2,t-s/2,i+e/2,t+s/2],er=({x:i,y:t,text:e},s)=>Fi([i+s[0],t-s[1],Ii*e.length+4,ji]),Ri=(i,{x:t,y:e})=>Math.hypot(Math.max(i[0]-t,0,t-i[2]),Math.max(i[1]-e,0,e-i[3]));function as(i,t){let e=Math.min(i[2],t[2])-Math.max(i[0],t[0]),s=Math.min(i[3],t[3])-Math.max(i[1],t[1]);return e>0&&s>0?e*s:0}var Bi=([i,t],[e,s])=>i*s-t*e,rt=([i,t],[e,s])=>[i-e,t-s],ls=([i,t])=>Math.hypot(i,t);function $t(i,t,e){let s=rt(e,t),n=rt(i,t),o=s[0]**2+s[1]**2,r=o>0?Math.min(1,Math.max(0,(s[0]*n[0]+s[1]*n[1])/o)):0;return ls(rt(n,[r*s[0],r*s[1]]))}var Ot=([[i,t],[e,s]])=>[[i,t],[e,t],[e,s],[i,s]],C=(i,t)=>i==="box"?Ot(t):t;function me([i,t],e){let s=!1;return e.forEach(([n,o],r)=>{let[a,l]=e[(r+1)%e.length];o>t!=l>t&&i<n+(t-o)/(l-o)*(a-n)&&(s=!s)}),s}function Di(i,t,e){if(t==="point")return ls(rt(i,e[0]));if(t==="segment")return $t(i,...e);if(t==="line"){let n=rt(e[1],e[0]);return Math.abs(Bi(n,rt(i,e[0])))/
ls(n)}let s=C(t,e);return me(i,s)?0:Math.min(...s.map((n,o)=>$t(i,n,s[(o+1)%s.length])))}var Wi=(i,t,e,s)=>{let n=(o,r,a)=>Math.sign(Bi(rt(r,o),rt(a,o)));return n(i,t,e)*n(i,t,s)<0&&n(e,s,i)*n(e,s,t)<0},be=i=>i.map((t,e)=>[t,i[(e+1)%i.length]]);function hs(i,t){return me(i[0],t)||me(t[0],i)?!0:be(i).some(([e,s])=>be(t).some(([n,o])=>Wi(e,s,n,o)))}function Yi([i,t],e){return me(i,e)||be(e).some(([s,n])=>Wi(i,t,s,n))?0:Math.min(...be(e).map(([s,n])=>Math.min($t(i,s,n),$t(t,s,n),$t(s,i,t),$t(n,i,t))))}var Xi=1e-6,Hi=90,sr=["fixed_pivot","moving_pivot"];function ue(i){if(i.chosen==="placed")return i.placed?.linkage??null;let t=i.followed?.linkages.find(({id:e})=>e===i.chosen);return t?.led?t:i.followed?.vanished?.some(({id:e})=>e===i.chosen)?null:i.solved?.linkages.find(({id:e})=>e===i.chosen)??null}var Ki={fixed_pivot:"fixed pivot",moving_pivot:"moving pivot"};function fe(i,t,e){let s=[];for(let r of sr){if(!i[r])continue;let[[a,l]]=Object.entries(i[r]),h=a==="point"?[l]:l,d=t[r]?Di(t[r],a,h):1/0;d>e&&s.push({key:r,dyad:t.id,away:d})}let{least:n=0,most:o=1/0}=i.length??{};return i.length&&t.
kind==="RR"&&(t.radius<n-e||t.radius>o+e)&&s.push({key:"length",dyad:t.id,away:Math.max(n-t.radius,t.radius-o)}),i.kinds&&!i.kinds.includes(t.kind)&&s.push({key:"kinds",dyad:t.id,away:1/0}),s}function Ui(i,t,e){let s=it(i),n=Xi*e,[o,r]=t.led;return s.length<2?s.map(a=>[...fe(a,o,n),...fe(a,r,n)]):ir(i,t,e).map((a,l)=>fe(s[l],a,n))}function ir(i,{led:[t,e]},s){let n=it(i),o=Xi*s,[r,a]=[[t,e],[e,t]].map(l=>n.length>1&&l.flatMap((h,d)=>fe(n[d],h,o)).length);return a<r?[e,t]:[t,e]}function Gi({key:i,dyad:t,away:e},s){let n=`${Number(e.toPrecision(2))}${s?` ${s}`:""}`;return i==="kinds"?`${t} is of\
 another kind.`:i==="length"?`The link of ${t} is ${n} beyond its range.`:e===1/0?`${t} has no ${Ki[i]}.`:`The ${Ki[i]} of ${t} is ${n} outside.`}function nr(i){let t=(i.pose_errors??[]).filter(d=>d.way!==null&&d.frame!==null);if(!t.length||!i.ways?.length)return[];let e=new Map;for(let{way:d}of t)e.set(d,(e.get(d)??0)+1);let[s]=[...e].sort((d,p)=>p[1]-d[1])[0],n=i.ways[s],o=t.filter(d=>d.way===s).map(({frame:d})=>d),r=Math.floor(Math.min(...o)),a=Math.ceil(Math.max(...o)),l=Math.max(1,Math.ceil((a-r)/Hi)),h=[];for(let d=r;d<=a&&d<n.x.length;d+=l)h.push({x:n.x[d],y:n.y[d],a:n.angle[d]});return h}
var or=i=>i.polygon??(i.box?Ot(i.box):null),qi=(i,t)=>i.map(e=>$(t,e));function rr(i,t){let{x:e,y:s,angle:n}=A(i,t);return{x:e,y:s,a:S(n)}}function Zi(i,t,e){let s=nr(t),n=i.surroundings?.link_width??0,o=i.surroundings?.margin??0,r=Math.ceil(i.poses.length/Hi),a=[...i.poses.keys()].filter(l=>l%r===0);return j(i).map(l=>{let h=or(l);if(!h)return"";let d=e.length>2?a.find(p=>hs(qi(e,rr(i,p)),h)):void 0;if(d!==void 0)return`The body touches it at pose ${V(i,d)}.`;if(!s.length)return"";if(e.length>2&&s.some(p=>hs(qi(e,p),h)))return"The body touches it.";for(let p of t.led){if(p.kind!=="RR")continue;
let c=Math.min(...s.map(m=>Yi([p.fixed_pivot,$(m,p.moving_pivot)],h)));if(c===0||c<n/2)return`The link of ${p.id} touches it.`;if(c<n/2+o)return`The link of ${p.id} comes nearer than the margin.`}return""})}var ar=9,lr=6,hr=4,dr=5,Vi=15,pr=2.2,cr=1,Ji=40,Qi=i=>Number(i.toFixed(1))+0,ge=class{isOn=!0;constructor(t,e){this.store=t,this.scene=e,this.text=b("text",{class:"bs-snap-name"}),this.mark=b("path",{class:"bs-snap-mark"}),this.element=b("g",{class:"bs-snap","aria-hidden":"true"},this.mark,this.text);for(let s of["dropped","tool"])e.on(s,()=>this.clear())}clear(){this.element.remove()}show(t,e){let[s,n]=t,{view:o}=this.scene,r=o.X(s),a=o.Y(n);f(this.mark,"d",`M${x(r)} ${x(a)}m-7 0h14m-7 -7v14`),f(this.text,"x",x(r+10)),f(this.text,"y",x(a-10)),_(this.text,e),this.scene.layer("tool").append(this.
element)}place(t){let{x:e,y:s,angle:n}=A(this.store.document,t);return{x:e,y:s,a:S(n)}}targets(){let{store:t}=this,{document:e}=t,s=[...e.poses.keys()].slice(0,Ji),n=[],o=[],r=(a,l,h,d={x:0,y:0,a:0})=>n.push(...a.map(p=>({at:$(d,p),name:`corner of ${l}`,of:h,isStated:!d.x&&!d.y&&!d.a})));for(let a of ue(t)?.led??[])a.fixed_pivot&&n.push({at:a.fixed_pivot,name:`fixed pivot of ${a.id}`,of:"linkage"}),a.moving_pivot&&s.length&&n.push({at:$(this.place(t.referenceIndex),a.moving_pivot),name:`moving pivot of ${a.id}`,of:"linkage"});j(e).forEach((a,l)=>(a.box||a.polygon)&&r(a.polygon??C("box",a.box),
a.name??`region ${l+1}`,`region ${l}`)),X(e).forEach(({key:a,shape:l,points:h},d)=>a==="fixed_pivot"&&r(C(l,h),"the limit",`limit ${d}`));for(let a of s){let{x:l,y:h,a:d}=this.place(a),p=`pose ${V(e,a)}`,c=`pose ${a}`;if(n.push({at:[l,h],name:p,of:c,isStated:!0}),e.poses[a].angle!==void 0)for(let m of[0,90])o.push({at:[l,h],along:[Math.cos(d+S(m)),Math.sin(d+S(m))],name:`${m?"y":"x"} axis of ${p}`,of:c});r(Z(e),`the body at ${p}`,`body ${c}`,{x:l,y:h,a:d})}return{points:n,lines:o}}point([t,e],{event:s,from:n=null,skip:o=()=>!1}={}){let{scene:r}=this,{scale:a}=r.view,l=v=>v.map(y=>r.rounded(y));
if(this.clear(),s?.shiftKey&&n){let v=Math.abs(t-n[0])>=Math.abs(e-n[1]),y=v?[r.rounded(t),n[1]]:[n[0],r.rounded(e)];return this.show(y,v?"horizontal":"vertical"),y}if(!this.isOn||s?.altKey)return l([t,e]);let{points:h,lines:d}=this.targets(),p=({at:v,along:y})=>a*(y?Math.abs((t-v[0])*y[1]-(e-v[1])*y[0]):Math.hypot(t-v[0],e-v[1])),c=(v,y)=>v.filter(({of:P})=>!o(P)).map(P=>({...P,away:p(P)})).filter(P=>P.away<y).sort((P,F)=>P.away-F.away)[0],m=c(h,ar),g=m?null:c(d,lr);if(m)return this.show(m.at,m.name),m.isStated?m.at:l(m.at);if(g){let{at:v,along:y}=g,P=(t-v[0])*y[0]+(e-v[1])*y[1],F=[v[0]+P*y[0],
v[1]+P*y[1]];return this.show(F,g.name),l(F)}let w=this.gridStep,k=[t,e].map(v=>{let y=Number((Math.round(v/w)*w).toPrecision(12));return a*Math.abs(y-v)<hr?y:null}),M=l([t,e]).map((v,y)=>k[y]??v);return k.some(v=>v!==null)&&this.show(M,k.includes(null)?`grid, ${k[0]===null?"y":"x"} ${k[0]??k[1]}`:"grid"),M}get gridStep(){let{view:t}=this.scene,[e,s]=ut(t.x(0),t.x(t.width),t.width/110);return(s?s.at-e.at:10**Math.round(Math.log10(100/t.scale)))/dr}angle(t,e,{event:s,skip:n=-1}){this.clear();let o=Vi*Math.round(t/Vi);if(s?.altKey||!this.isOn&&!s?.shiftKey)return Qi(t);if(s?.shiftKey||Math.abs(o-
t)<pr)return this.show(e,`${o}°`),o;let{document:r}=this.store,a=d=>Math.abs((d.angle-t+540)%360-180),l=r.poses.slice(0,Ji).findIndex((d,p)=>p!==n&&d.angle!==void 0&&a(d)<cr);if(l<0)return Qi(t);let h=r.poses[l].angle;return this.show(e,`parallel to pose ${V(r,l)}`),h+360*Math.round((t-h)/360)}};var mr=["grid","regions","ghosts","map","curves","paths","mechanism","limits","pivots","poses","labels","tool"],tn=46,br=1.0018,en=1e6,sn=4,fr=8,xe=class{view;pressed=null;field;constructor(t,{zoomKey:e=!1}={}){this.store=t,this.zoomKey=e,this.listeners={view:[],click:[],tool:[],dropped:[],closer:[],marquee:[],key:[]},this.tool=null,this.dragged=null,this.layers=new Map(mr.map(s=>[s,b("g",{class:`bs-layer bs-layer-${s}`})])),this.layers.get("grid").setAttribute("aria-hidden","true"),this.svg=b("svg",{class:"bs-scene",tabindex:0,role:"group","aria-label":"The plane: poses, linkage and limits. A\
rrow keys pan, plus and minus zoom, 0 fits."},...this.layers.values()),this.element=u("div",{class:"bs-plane"},this.svg),this.size={width:640,height:480},this.origin={scale:1,left:320,top:240},this.isFitted=!0,this.pointers=new Map,this.boxes=[],this.names=new pe(this),this.marquee=b("rect",{class:"bs-marquee"}),this.snap=new ge(t,this),this.update(),this.listen(),this.field=new de(t,this),t.on("document",()=>this.unit===t.document.length_unit||this.grid()),new ResizeObserver(()=>this.resize()).observe(this.element),addEventListener("scroll",()=>this.box=null,{capture:!0,passive:!0})}layer(t){
return this.layers.get(t)}on(t,e){this.listeners[t].push(e)}emit(t,...e){return this.listeners[t].map(s=>s(...e)).some(Boolean)}hold(t,e=!1){this.boxes.push({fn:t,far:e})}update(){let{width:t,height:e}=this.size,{scale:s,left:n,top:o}=this.origin;this.view={scale:s,left:n,top:o,width:t,height:e,X:r=>n+s*r,Y:r=>o-s*r,x:r=>(r-n)/s,y:r=>(o-r)/s},Object.assign(this.svg.dataset,{scale:s,left:n,top:o,fit:this.isFitted?this.isWhole?"all":"near":""}),this.grid(),this.emit("view",this.view)}resize(){this.box=null;let{width:t,height:e}=this.svg.getBoundingClientRect();!t||!e||t===this.size.width&&e===this.
size.height||(this.dragged||(this.origin={...this.origin,left:this.origin.left+(t-this.size.width)/2,top:this.origin.top+(e-this.size.height)/2}),this.size={width:t,height:e},f(this.svg,"viewBox",`0 0 ${t} ${e}`),this.refit()||this.update())}refit(){return!this.isFitted||this.dragged?!1:(this.fit(this.isWhole),!0)}pan(t,e){this.isFitted=!1,this.origin={...this.origin,left:this.origin.left+t,top:this.origin.top+e},this.update()}zoom(t,e,s){let n=this.fittedScale??this.origin.scale,o=E(this.origin.scale*t,n/en,n*en),r=o/this.origin.scale;this.isFitted=!1,this.origin={scale:o,left:e+r*(this.origin.
left-e),top:s+r*(this.origin.top-s)},this.update()}fit(t=!1){let e=s=>this.boxes.filter(({far:n})=>n===s).flatMap(({fn:n})=>n());this.isWhole=t,this.isFitted=!0,this.fitBox(ns(e(!1),e(!0),t))}fitBox(t){let[e,s,n,o]=Number.isFinite(t[0])?t:[-50,-50,50,50],r=.1*(Math.max(n-e,o-s)||Math.max(1,Math.abs(n),Math.abs(o))),{width:a,height:l}=this.size,h=Math.max(0,r-n+e)/2,d=Math.max(0,r-o+s)/2,{scale:p,left:c,top:m}=Ct([e-h,s-d,n+h,o+d],a,l,Math.min(tn,a/8));this.fittedScale=p,this.origin={scale:p,left:c,top:m},this.update()}fitAgain(){this.fit(this.isFitted&&!this.isWhole)}closeUp(t){this.isFitted=!1,
this.fitBox(G(t))}reveal(t){let{view:e}=this,s=Math.min(tn,e.width/8);this.closeUp([t,[e.x(s),e.y(s)],[e.x(e.width-s),e.y(e.height-s)]])}grid(){let{view:t}=this,{width:e,height:s}=t,n=this.layer("grid"),o=this.unit=this.store.document.length_unit,r=o?` ${o}`:"",a=ut(t.x(0),t.x(e),e/110),l=ut(t.y(s),t.y(0),s/80),h=[...a.map(({at:p})=>`M${x(t.X(p))} 0V${s}`),...l.map(({at:p})=>`M0 ${x(t.Y(p))}H${e}`)],d=`M${x(E(t.X(0),-9,e+9))} 0V${s}M0 ${x(E(t.Y(0),-9,s+9))}H${e}`;n.replaceChildren(b("path",{class:"bs-grid-line",d:h.join("")}),b("path",{class:"bs-grid-axis",d}),...a.filter(({at:p})=>t.X(p)>46&&
t.X(p)<e-(r?54:30)).map(({at:p,text:c})=>b("text",{x:x(t.X(p)),y:s-6,"text-anchor":"middle"},c)),...l.filter(({at:p})=>t.Y(p)>30&&t.Y(p)<s-24).map(({at:p,text:c})=>b("text",{x:6,y:x(t.Y(p)-4)},c)),b("text",{x:6,y:14},`y${r}`),b("text",{x:e-6,y:s-6,"text-anchor":"end"},`x${r}`))}get grain(){return 10**Math.floor(Math.log10(.35/this.view.scale))}rounded(t){let{grain:e}=this,s=E(-Math.round(Math.log10(e)),0,12);return Number((Math.round(t/e)*e).toFixed(s))+0}get step(){let[t,e,s,n]=G(this.store.document.poses.map(r=>[r.x??0,r.y??0])),o=Math.hypot(s-t,n-e);return Number.isFinite(o)&&o>0?10**Math.floor(
Math.log10(o/50)):1}at(t){this.box||(this.box=this.svg.getBoundingClientRect(),this.dragged||requestAnimationFrame(()=>this.dragged||(this.box=null)));let{left:e,top:s}=this.box,n=t.clientX-e,o=t.clientY-s;return{X:n,Y:o,x:this.view.x(n),y:this.view.y(o)}}drag(t,{start:e=()=>!0,move:s,end:n=()=>{},cancel:o=()=>{},click:r=()=>{}}){t.addEventListener("pointerdown",a=>{if(a.button!==0||this.tool||this.dragged)return;a.preventDefault(),a.stopPropagation(),this.pressed=a,t.focus?.({preventScroll:!0}),this.pressed=null;let l=this.at(a),h=new AbortController,{signal:d}=h,p=!1,c=M=>{h.abort(),this.dragged=
this.box=null,this.svg.classList.remove("bs-grasped"),this.svg.hasPointerCapture?.(a.pointerId)&&this.svg.releasePointerCapture(a.pointerId),M(),this.emit("dropped")};this.dragged={cancel:()=>c(()=>p&&o())},this.capture(a);let m=(M,v)=>this.svg.addEventListener(M,y=>y.pointerId===a.pointerId&&v(y),{signal:d}),g=l,w=a.timeStamp,k=M=>{let v=this.at(M);if(!(v.X===g.X&&v.Y===g.Y)){if(g=v,w=M.timeStamp,!p){if(Math.hypot(v.X-l.X,v.Y-l.Y)<sn)return;if(p=e(l,a)!==!1,!p)return c(()=>{});this.svg.classList.add("bs-grasped")}s(v,M)}};m("pointermove",k),m("pointerrawupdate",M=>M.timeStamp-w>=fr&&k(M)),m("\
pointerup",M=>c(()=>p?n(this.at(M)):r(a))),m("pointercancel",()=>c(()=>p&&o()))})}use(t){let e=this.tool;this.tool=t??null,e?.end?.(),this.svg.classList.toggle("bs-drawing",!!t),this.emit("tool",this.tool),t&&this.svg.focus({preventScroll:!0})}listen(){let{svg:t}=this;t.addEventListener("wheel",e=>{if(this.zoomKey&&!e.ctrlKey&&!e.metaKey)return;e.preventDefault();let{X:s,Y:n}=this.at(e),o=e.deltaMode===1?16:1;this.zoom(br**(-e.deltaY*o*(e.ctrlKey&&!this.zoomKey?4:1)),s,n)},{passive:!1}),t.addEventListener("pointerdown",e=>this.press(e)),t.addEventListener("pointermove",e=>this.moved(e));for(let e of[
"pointerup","pointercancel"])t.addEventListener(e,s=>this.released(s));t.addEventListener("keydown",e=>this.key(e))}capture({pointerId:t}){try{this.svg.setPointerCapture(t)}catch{}}press(t){if(t.button!==0&&t.button!==1)return;let{X:e,Y:s}=this.at(t);if(this.pointers.set(t.pointerId,{X:e,Y:s,from:{X:e,Y:s},button:t.button,isMarquee:t.shiftKey&&!this.tool}),this.pointers.size>1)for(let n of this.pointers.values())n.panned=!0;this.capture(t)}moved(t){let e=this.at(t),s=this.pointers.get(t.pointerId);if(!s){this.dragged||this.tool?.hover?.(e,t);return}let n={X:s.X,Y:s.Y};if(Object.assign(s,{X:e.X,
Y:e.Y}),this.pointers.size===2){let[o,r]=this.pointers.values(),a=s===o?r:o,[l,h]=[e,n].map(({X:d,Y:p})=>Math.hypot(d-a.X,p-a.Y));h>0&&this.zoom(l/h,(e.X+a.X)/2,(e.Y+a.Y)/2);return}if(s.panned||=Math.hypot(e.X-s.from.X,e.Y-s.from.Y)>sn,!!s.panned){if(s.isMarquee)return void this.stretch(s);this.tool?.drag?.(e,s,t)||(this.svg.classList.add("bs-grasped"),this.pan(e.X-n.X,e.Y-n.Y))}}released(t){let e=this.pointers.get(t.pointerId);if(!e)return;this.pointers.delete(t.pointerId),this.svg.classList.remove("bs-grasped");let s=this.at(t);t.type==="pointercancel"?this.tool?.hover?.(null):e.panned&&e.isMarquee?
this.caught(e):e.panned?this.tool?.release?.(s,e):e.button===0&&(this.tool?this.tool.click(s,t):this.emit("click",s,t))}stretch({X:t,Y:e,from:s}){for(let[n,o]of Object.entries({x:Math.min(t,s.X),y:Math.min(e,s.Y),width:Math.abs(t-s.X),height:Math.abs(e-s.Y)}))f(this.marquee,n,o);this.layer("tool").append(this.marquee)}caught({X:t,Y:e,from:s}){let{view:n}=this;this.marquee.remove(),this.emit("marquee",G([[n.x(t),n.y(e)],[n.x(s.X),n.y(s.Y)]]))}key(t){if(t.target!==this.svg||t.ctrlKey||t.metaKey||this.emit("key",t)||t.altKey)return;let e=t.shiftKey?160:40,{width:s,height:n}=this.size,o={ArrowLeft:[
e,0],ArrowRight:[-e,0],ArrowUp:[0,e],ArrowDown:[0,-e]};if(o[t.key])this.pan(...o[t.key]);else if(t.key==="+"||t.key==="=")this.zoom(1.25,s/2,n/2);else if(t.key==="-")this.zoom(.8,s/2,n/2);else if(t.key==="0")this.fitAgain();else if(t.key==="z")this.emit("closer");else return;t.preventDefault()}},B=class{constructor(t,e,s){this.group=t,this.make=e,this.show=s,this.elements=new Map}draw(t){let e=new Map;for(let[n,o]of t){let r=this.elements.get(n)??this.make(n,o);e.set(n,r),this.show(r,o)}for(let[n,o]of this.elements)e.has(n)||o.remove();let s=null;for(let n of e.values()){let o=s?s.nextSibling:
this.group.firstChild;(n!==o||n.parentNode!==this.group)&&this.group.insertBefore(n,o),s=n}this.elements=e}};var ur={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},gr=3,nn=new Set(["box","polygon"]),_t={x:0,y:0,a:0};function ds(i,t,e,s){let n=C(i,t).map(o=>$(e,o)).map(([o,r])=>[s.X(o),s.Y(r)]);if(i==="point")return`M${x(n[0][0]-7)} ${x(n[0][1])}h14m-7 -7v14`;if(i==="line"){let[[o,r],[a,l]]=n,h=Math.hypot(a-o,l-r)||1,d=s.width+s.height+Math.hypot(o,r),[p,c]=[d*(a-o)/h,d*(l-r)/h];return`M${x(o-p)} ${x(r-c)}L${x(a+p)} ${x(l+c)}`}return`M${n.map(o=>o.map(x).join(" ")).join("L")}${nn.has(i)?"Z":""}`}function we(i,t,e,s){if(i!=="box")return t.map((o,r)=>r===e?s:o);let n=Ot(t)[(e+2)%4];return[
[Math.min(s[0],n[0]),Math.min(s[1],n[1])],[Math.max(s[0],n[0]),Math.max(s[1],n[1])]]}var at=class{constructor(t,{what:e,set:s,remove:n,select:o,abandon:r,className:a=""}){this.scene=t,this.what=e,this.set=s,this.remove=n,this.select=o,this.abandon=r,this.title=b("title"),this.area=b("path",{class:"bs-shape-area",tabindex:0,role:"button"},this.title),this.line=b("path",{class:"bs-shape-line"}),this.element=b("g",{class:`bs-shape ${a}`},this.line,this.area),this.middles=new B(b("g"),(l,h)=>this.makeMiddle(h),(l,h)=>this.showMiddle(l,h)),this.corners=new B(b("g"),(l,h)=>this.makeCorner(h),(l,h)=>this.
showCorner(l,h)),this.handles=b("g",{class:"bs-corners"},this.middles.group,this.corners.group),this.dragWhole(),this.area.addEventListener("focus",()=>this.select()),this.area.addEventListener("keydown",l=>this.keys(l,(h,d)=>h.map(([p,c])=>[H(p,d[0]),H(c,d[1])]),()=>this.remove()))}draw(){let{shape:t,points:e,place:s,name:n,selected:o,state:r,data:a}=this.now=this.what(),l=ds(t,e,s,this.scene.view);f(this.line,"d",l),f(this.area,"d",l),this.area.classList.toggle("bs-open",!nn.has(t)),f(this.area,"aria-label",`${n}${r?`, ${r} by the chosen linkage`:""}. Drag, or use the arrow keys; Delete remo\
ves it.`),f(this.area,"aria-pressed",!!o),_(this.title,n);for(let[m,g]of Object.entries({...a,shape:t}))f(this.element,`data-${m}`,g);this.element.classList.toggle("bs-selected",!!o),this.element.classList.toggle("bs-met",r==="met"),this.element.classList.toggle("bs-broken",r==="broken");let[[h,d]]=Object.entries(a);f(this.handles,"data-handles",`${h} ${d}`.trim()),this.handles.parentNode||this.scene.layer("tool").append(this.handles);let p=o?C(t,e).length:0,c=t==="polygon"?p:0;this.corners.draw([...Array(p).keys()].map(m=>[m,m])),this.middles.draw([...Array(c).keys()].map(m=>[m,m]))}clear(){this.
element.remove(),this.handles.remove()}at([t,e]){let[s,n]=$(this.now.place,[t,e]);return{cx:x(this.scene.view.X(s)),cy:x(this.scene.view.Y(n))}}point({x:t,y:e},s,n){let{place:o}=this.now,r=this.handles.dataset.handles??"",a=this.scene.snap.point([t,e],{event:s,from:n&&$(o,n),skip:l=>l.startsWith(r)});return this.inFrame(a)}inFrame(t){let{place:e}=this.now;return e.x||e.y||e.a?pt(e,t).map(s=>this.scene.rounded(s)):t}openField(t){let{now:{name:e,place:s}}=this,n=()=>C(this.now.shape,this.now.points)[t];this.scene.field.open({name:`corner ${t+1} of ${e}`,kind:this.scene.store.selection?.kind,fields:[
["x","x","length"],["y","y","length"]],at:()=>n()&&this.element.isConnected&&$(s,n()),values:()=>({x:n()[0],y:n()[1]}),set:({x:o=n()[0],y:r=n()[1]})=>this.set(we(this.now.shape,this.now.points,t,[o,r]),null)})}dragWhole(){let t,e,s,n;this.scene.drag(this.area,{start:o=>{let r=h=>Math.hypot(...$(this.now.place,h).map((d,p)=>d-[o.x,o.y][p]));t=Symbol("move a shape"),s=this.now.points,n=s.reduce((h,d)=>r(d)<r(h)?d:h);let[a,l]=$(this.now.place,n);e=[a-o.x,l-o.y]},move:(o,r)=>{let a=this.point({x:o.x+e[0],y:o.y+e[1]},r,n),l=[a[0]-n[0],a[1]-n[1]];this.set(s.map(([h,d])=>[H(h,l[0]),H(d,l[1])]),t)},cancel:()=>this.
abandon(t),click:()=>this.select()})}makeCorner(t){let e=b("circle",{class:"bs-corner",r:6,tabindex:0,role:"button","data-corner":t+1}),s,n;return this.scene.drag(e,{start:()=>{s=Symbol("move a corner"),n=C(this.now.shape,this.now.points)[t],this.openField(t)},move:(o,r)=>this.set(we(this.now.shape,this.now.points,t,this.point(o,r,n)),s),cancel:()=>this.abandon(s),click:()=>this.openField(t)}),e.addEventListener("keydown",o=>this.keys(o,(r,a)=>{let[l,h]=C(this.now.shape,r)[t];return we(this.now.shape,r,t,[H(l,a[0]),H(h,a[1])])},()=>this.removeCorner(t))),e}removeCorner(t){let{shape:e,points:s}=this.
now;e!=="polygon"||s.length<=gr||this.set(s.filter((n,o)=>o!==t),null)}makeMiddle(t){let e=b("circle",{class:"bs-middle",r:4.5,"data-edge":t+1}),s;return this.scene.drag(e,{start:()=>{s=Symbol("add a corner"),this.set([...this.now.points.slice(0,t+1),this.now.points[t],...this.now.points.slice(t+1)],s)},move:(n,o)=>this.set(we("polygon",this.now.points,t+1,this.point(n,o)),s),cancel:()=>this.abandon(s)}),e}showCorner(t,e){let s=C(this.now.shape,this.now.points)[e];for(let[n,o]of Object.entries(this.at(s)))f(t,n,o);f(t,"aria-label",`Corner ${e+1} of ${this.now.name}: ${s.join(", ")}`)}showMiddle(t,e){
let{points:s}=this.now,n=s[(e+1)%s.length],o=this.at([(s[e][0]+n[0])/2,(s[e][1]+n[1])/2]);for(let[r,a]of Object.entries(o))f(t,r,a)}keys(t,e,s){if(t.ctrlKey||t.metaKey)return;let n=ur[t.key];if(n){t.repeat||(this.keyed=Symbol("keys"));let o=Bt(t,this.scene.step);this.set(e(this.now.points,[o*n[0],o*n[1]]),this.keyed)}else if(t.key==="Delete"||t.key==="Backspace")s();else return;t.preventDefault(),t.stopPropagation()}};var xr=12,ps=new Set(["segment","line","box"]),on={point:"Click the point. Enter puts it in the middle, Escape gives up.",segment:"Click both ends. Enter puts one in the middle, Escape gives up.",line:"Click two points of the line. Enter puts one in the middle, Escape gives up.",box:"Drag from corner to corner, or click both. Enter puts one in the middle, Escape gives up.",polygon:"Click the corners; Enter or a click on the first one closes. Backspace takes the last one back, Escape gives up."},wr={point:[[0,0]],segment:[[-1,0],[1,0]],line:[[-1,0],[1,0]],box:[[-1,-1],[1,1]],polygon:[[-1,-1],[1,
-1],[0,1]]},vr=.12,yr=([[i,t],[e,s]])=>[[Math.min(i,e),Math.min(t,s)],[Math.max(i,e),Math.max(t,s)]],rn=([[i,t],[e,s]])=>i===e&&t===s,lt=class{constructor(t,{shape:e,place:s,done:n,name:o,at:r=""}){this.scene=t,this.shape=e,this.place=s,this.done=n,this.name=o,this.points=[],this.next=null,this.hint=r?`${r}. ${on[e]}`:on[e],this.isOfBody=!!r,this.path=b("path",{class:"bs-draft"}),this.dots=b("g"),this.element=b("g",{},this.path,this.dots),t.layer("tool").append(this.element)}point({x:t,y:e},s){let n=this.place(),o=this.points.at(-1),r=this.scene.snap.point([t,e],{event:s,from:o&&$(n,o)});return n.
x||n.y||n.a?pt(n,r).map(a=>this.scene.rounded(a)):r}click(t,e){let s=this.point(t,e);if(this.shape==="polygon"){if(this.points.length>2&&(this.isFirst(t)||e?.detail>1))return this.finish(this.points);if(this.points.length&&rn([this.points.at(-1),s]))return}return this.points.push(s),this.shape==="point"||ps.has(this.shape)&&this.points.length===2?this.finish(this.points):this.draw()}isFirst({X:t,Y:e}){let[s,n]=$(this.place(),this.points[0]),{view:o}=this.scene;return Math.hypot(o.X(s)-t,o.Y(n)-e)<xr}hover(t,e){this.next=t&&this.point(t,e),this.draw()}drag(t,e,s){return!ps.has(this.shape)||this.
points.length?!1:(this.dragging=[this.point(this.inPlane(e.from),s),this.point(t,s)],this.draw(),!0)}inPlane({X:t,Y:e}){return{x:this.scene.view.x(t),y:this.scene.view.y(e)}}inMiddle(){let{width:t,height:e}=this.scene.size,s=vr*Math.min(t,e);return wr[this.shape].map(([n,o])=>this.point(this.inPlane({X:t/2+s*n,Y:e/2-s*o})))}release(){if(!this.dragging)return;let t=this.dragging;this.dragging=null,this.finish(t)}finish(t){return ps.has(this.shape)&&rn(t)?(this.points=t.slice(0,1),this.draw()):(this.scene.use(null),this.done(this.shape==="box"?yr(t):t))}key(t){if(t.key==="Escape")this.scene.use(
null);else if(t.key==="Backspace")this.points.pop();else if(t.key==="Enter"&&!this.points.length)this.finish(this.inMiddle());else if(t.key==="Enter"&&this.points.length>2)this.finish(this.points);else return!1;return this.draw(),!0}draw(){let{scene:{view:t},shape:e}=this,s=this.dragging??[...this.points,...this.next?[this.next]:[]],n=this.place(),o=e==="polygon"?"open polygon":e,r=s.length>1||e==="point";f(this.path,"d",r&&s.length?ds(o,s,n,t):""),this.dots.replaceChildren(...(this.dragging??this.points).map(a=>$(n,a)).map(([a,l],h)=>b("circle",{class:h?"bs-draft-dot":"bs-draft-dot bs-first",
r:4,cx:x(t.X(a)),cy:x(t.Y(l))})))}end(){this.element.remove()}};var an=.4;function ve(i){let t=i.referenceIndex;if(t<0)return{x:0,y:0,a:0};let{x:e,y:s,angle:n}=A(i.document,t);return{x:e,y:s,a:S(n)}}var cs=i=>`Drawn at pose ${V(i.document,Math.max(0,i.referenceIndex))}`,ye=class{constructor(t,e){this.store=t,this.scene=e,this.ghosts=new B(b("g",{class:"bs-ghosts","aria-hidden":"true"}),()=>b("path",{class:"bs-ghost"}),(s,n)=>this.showGhost(s,n)),e.layer("ghosts").append(this.ghosts.group),this.handles=new at(e,{className:"bs-body-shape",what:()=>({shape:"polygon",points:Z(t.document),place:ve(t),name:"Outline of the body",selected:t.selection?.kind==="body",
data:{body:""}}),set:(s,n)=>t.edit(o=>Vt(o,s),{gesture:n}),remove:()=>t.edit(s=>Vt(s,[])),select:()=>t.select({kind:"body",index:0}),abandon:s=>t.abandon(s)}),t.on("document selection reference",()=>this.draw()),e.on("view",()=>this.draw()),t.on("document selection",()=>this.watch()),e.on("tool",()=>this.watch()),this.draw()}watch(){let{store:t,scene:e}=this,{selection:s,document:n}=t,o=s?.kind==="body"||s?.kind==="limit"&&nt(X(n)[s.index]?.key??""),r=!!(e.tool?.isOfBody||o);r!==t.isOnBody&&(t.isOnBody=r,e.svg.classList.toggle("bs-on-body",r),t.emit("reference"))}indices(){let{document:{poses:t},
selectedPoses:e,referenceIndex:s}=this.store;return t.map((n,o)=>o).filter(n=>Ei(n,t.length)||e.includes(n)||n===s&&this.store.isOnBody)}draw(){let t=Z(this.store.document),{scale:e}=this.scene.view;return this.path=t.length?`M${t.map(([s,n])=>`${x(e*s)} ${x(-e*n)}`).join("L")}Z`:"",this.ghosts.draw(t.length?this.indices().map(s=>[s,s]):[]),!t.length||!this.store.document.poses.length?this.handles.clear():(this.handles.element.parentNode||this.scene.layer("ghosts").append(this.handles.element),this.handles.draw())}showGhost(t,e){let{view:s}=this.scene,{x:n,y:o,angle:r}=A(this.store.document,e),
a=Math.max(1,this.store.document.poses.length-1);t.classList.toggle("bs-reference",e===this.store.referenceIndex),Ft(t,[s,n,o,r,e/a,this.path])&&(f(t,"d",this.path),f(t,"opacity",(an+(1-an)*e/a).toFixed(3)),f(t,"transform",R(s.X(n),s.Y(o),S(r))))}tool(){return new lt(this.scene,{shape:"polygon",name:"body",place:()=>ve(this.store),at:cs(this.store),done:t=>{this.store.edit(e=>Vt(e,t)),this.store.select({kind:"body",index:0})}})}};var kr="button, input, select, textarea, summary, a, [role=button], [role=slider]",ms=i=>i?.matches?.("input:not([type=checkbox]):not([type=radio]):not([type=range]), textarea");function ln(i,t,e=null,s=document){let n=o=>({z:()=>o.shiftKey?i.redo():i.undo(),y:()=>i.redo(),...e&&{s:()=>e.save(),o:()=>e.chooser.click()}});s.addEventListener("keydown",o=>{let{key:r,target:a}=o;if((o.ctrlKey||o.metaKey)&&!o.altKey){let h=n(o)[r.toLowerCase()];if(!h||ms(a)&&a.dataset.typing==="true"&&/^[zy]$/i.test(r))return;o.preventDefault(),h()}else t.dragged&&r==="Escape"?(o.preventDefault(),t.dragged.cancel()):
t.tool&&!ms(a)&&t.tool.key(o)?(o.preventDefault(),o.stopPropagation()):r==="Escape"&&!ms(a)&&i.selection&&i.select(null)},!0),t.svg.addEventListener("keydown",o=>{if(o.key!=="Tab"||o.shiftKey||o.target!==t.svg)return;let r=t.svg.querySelector(".bs-pose.bs-selected .bs-origin, .bs-pose .bs-origin");r&&(o.preventDefault(),r.focus())}),s.addEventListener("input",({target:o})=>o instanceof HTMLElement&&(o.dataset.typing="true"));for(let o of["change","focusout"])s.addEventListener(o,({target:r})=>r instanceof HTMLElement&&delete r.dataset.typing)}function hn({player:i},t=document){t.addEventListener(
"keydown",e=>{e.key!==" "||e.ctrlKey||e.metaKey||e.altKey||e.target instanceof Element&&e.target.closest(kr)||!i.path||(e.preventDefault(),i.play(!i.playing))})}var Mr=zt+10,Dt=14,$r="M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9",dn=[18,10],Or=5,pn=15,_r=24;var St=class{constructor({led:t,drawn:e=[],ground:s,names:n}){this.kinds=cn(t),this.outline=b("path",{class:"bm-body-outline"}),this.links=b("g"),this.blocks=b("g"),this.pins=b("g"),this.coupler=b("g",{class:"bm-coupler"}),this.arrow=b("path",{class:"bm-drive-mark bm-side0"}),this.letter=b("text",{class:"bm-letter","text-anchor":"middle"},"M"),this.plates=[b("path",{class:"bm-plate-rim"}),b("path",{class:"bm-plate"})],this.coupler.append(...this.plates),this.parts=t.map((o,r)=>new Er[o.kind](this,r)),e.length&&this.parts.push(...e.map(o=>new gs(this,o)),new xs(this,s,n)),this.coupler.append(b(
"path",{class:"bm-body-frame",d:ot(Mr)}),b("circle",{class:"bm-origin",r:4}));for(let o of this.parts)o.pin&&this.coupler.append(o.pin);this.marks=new oe,this.group=b("g",{class:"bm-linkage"},this.arrow,this.links,this.coupler,this.blocks,this.pins,this.marks.group,e.length?null:this.letter)}fits({led:t}){return cn(t)===this.kinds}shape(t,e,s,n){this.view=s,this.led=e.led,this.hasBody=!!t.body,this.hasBody?(f(this.outline,"d",Si(t,s)),this.outline.parentNode||this.group.prepend(this.outline)):this.outline.remove();let o=[[0,0]];e.led.forEach((a,l)=>{a.moving_pivot&&o.push($e(a.moving_pivot,s));
let h=this.parts[l].shape(a,s,n);h&&o.push(h)});let r=`M${bi(o).map(a=>a.map(x).join(" ")).join("L")}Z`;for(let a of e.drawn?[]:this.plates)f(a,"d",r);for(let a of this.parts.slice(e.led.length))a.shape(s);this.marks.shape(t,e,s),this.shapeArrow()}show(t,e=null){let{view:s}=this,n=R(s.X(t.x),s.Y(t.y),t.a);this.marks.show(t,e),f(this.coupler,"transform",n),this.hasBody&&f(this.outline,"transform",n);for(let l of this.parts)l.show(t);let[o,r]=$(t,[Dt/s.scale,-Dt/s.scale]);f(this.letter,"transform",`translate(${x(s.X(o))} ${x(s.Y(r)+4)})`);let[a]=this.led;a.kind==="PR"&&f(this.arrow,"transform",`${mn(
a,t,s)} translate(0 ${-_r})`)}shapeArrow(){let{arrow:t,view:e}=this,[s]=this.led;if(s.kind==="PR"&&f(t,"d","M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5"),!s.fixed_pivot)return;let[n,o]=s.fixed_pivot;f(t,"d",$r),f(t,"transform",`translate(${x(e.X(n))} ${x(e.Y(o))}) rotate(-90)`)}},cn=i=>i.map(t=>t.kind).join(),$e=([i,t],e)=>[e.scale*i,-e.scale*t];function mn(i,t,e){let[s,n]=$(t,i.moving_pivot),[o,r]=D(i);return R(e.X(s),e.Y(n),Math.atan2(o,-r))}var bn=(i,t,e)=>b("g",{class:`bm-block bm-side${i}`},b("rect",{x:-t/2,y:-e/2,width:t,height:e,rx:2}));function ke(i,[t,e],s){f(i,"cx",x(t)),f(i,"cy",x(e)),
f(i,"data-dyad",s.id)}var Wt=([i,t],e)=>[e.X(i),e.Y(t)],bs=class{constructor({links:t,pins:e},s){this.strokes=[b("path",{class:"bm-bar"}),b("path",{class:"bm-core"})],this.bar=b("g",{class:`bm-link bm-side${s}`},this.strokes),this.ground=b("circle",{class:"bm-pin bm-fixed-pin",r:4.5}),this.pin=b("circle",{class:"bm-pin",r:4.5}),t.append(this.bar),e.append(this.ground)}shape(t,e){this.dyad=t,this.view=e;for(let s of this.strokes)f(s,"d",`M0 0H${x(e.scale*t.radius)}`);ke(this.ground,Wt(t.fixed_pivot,e),t),ke(this.pin,$e(t.moving_pivot,e),t)}show(t){let{dyad:e,view:s}=this,[n,o]=e.fixed_pivot,[r,
a]=$(t,e.moving_pivot);f(this.bar,"transform",R(s.X(n),s.Y(o),Math.atan2(a-o,r-n)))}},fs=class{constructor({blocks:t},e){this.block=bn(e,...Rt),this.pin=b("circle",{class:"bm-pin",r:4.5}),t.append(this.block)}shape(t,e){this.dyad=t,this.view=e,f(this.block,"data-dyad",t.id),ke(this.pin,$e(t.moving_pivot,e),t)}show(t){f(this.block,"transform",mn(this.dyad,t,this.view))}},us=class{constructor({blocks:t,pins:e,coupler:s},n){this.strokes=["rim","plate","edge"].map(o=>b("path",{class:`bm-slot-${o}`})),this.strokes.push(b("path",{class:"bm-slot"})),this.block=bn(n,...dn),this.ground=b("circle",{class:"\
bm-pin bm-fixed-pin",r:4}),s.append(...this.strokes),t.append(this.block),e.append(this.ground)}shape(t,e,s){this.dyad=t,this.view=e;let[n,o]=s.length?ct(t,s):[0,0],r=(dn[0]/2+Or)/e.scale,a=h=>$e(mt(t,h),e),l=`M${[a(n-r),a(o+r)].map(h=>h.map(x).join(" ")).join("L")}`;for(let h of this.strokes)f(h,"d",l);for(let h of[this.strokes[3],this.block])f(h,"data-dyad",t.id);return ke(this.ground,Wt(t.fixed_pivot,e),t),a((n+o)/2)}show(t){let{dyad:e,view:s}=this,[n,o]=D(e),[r,a]=e.fixed_pivot;f(this.block,"transform",R(s.X(r),s.Y(a),t.a+Math.atan2(n,-o)))}},gs=class{constructor({links:t},{joints:e,kind:s}){
this.joints=[...e],this.strokes=[b("path",{class:"bm-bar"}),b("path",{class:"bm-core"})],t.append(b("g",{class:`bm-link bm-${s}${e.length>2?" bm-ternary":""}`,"data-link":e.replace("M","")},this.strokes))}shape(t){this.view=t}show(t){let e=`M${this.joints.map(s=>Wt(t.joints[s]??[t.x,t.y],this.view).map(x).join(" ")).join("L")}${this.joints.length>2?"Z":""}`;for(let s of this.strokes)f(s,"d",e)}},xs=class{constructor({pins:t},e,s){this.pins=[...Object.keys(e),...Object.keys(s)].map(n=>{let o=b("circle",{class:`bm-pin${n in e?" bm-fixed-pin":""}`,r:4.5,"data-joint":n});return{joint:n,pin:o,link:[
...s[n]??""],name:n in e?null:b("text",{class:"bm-name","text-anchor":"middle"},n)}}),t.append(...this.pins.map(({pin:n})=>n),...this.pins.flatMap(({name:n})=>n??[]))}shape(t){this.view=t}show({joints:t}){for(let{joint:e,pin:s,link:n,name:o}of this.pins){let[r,a]=Wt(t[e],this.view);if(f(s,"cx",x(r)),f(s,"cy",x(a)),!o)continue;let[l,h]=Sr(n.map(d=>Wt(t[d],this.view)),[r,a]);f(o,"x",x(r+pn*l)),f(o,"y",x(a+pn*h+4))}}};function Sr(i,[t,e]){let s=[0,1].map(a=>i.reduce((l,h)=>l+h[a],0)/i.length),n=t-s[0],o=e-s[1],r=Math.hypot(n,o);return r>1?[n/r,o/r]:[0,-1]}var Me=class{shape(){}show(){}},Er={RR:bs,
PR:fs,RP:us,PP:Me,crank:Me};var Pr=4e3;function Yt(i,t,e){let[s,n]=D(i),[o,r]=ct(i,t),a=e.scale*(r-o)/2+Rt[0],l=Rt[1]/2+1,[h,d]=(w=>[e.X(w[0]),e.Y(w[1])])(mt(i,(o+r)/2)),p=t.reduce((w,k)=>w+s*k.x+n*k.y-i.line.offset,0),c=Math.atan2(s,-n)+(p>0?Math.PI:0),m=Math.min(a,Pr),g="";for(let w=-m+4;w<m-2;w+=8)g+=`M${x(w+4)} ${l}l-6 7`;return{x:h,y:d,half:a,drawn:m,turned:c,paths:[`M${x(-a)} ${l}H${x(a)}${g}`,`M${x(-a)} ${-l}H${x(a)}`]}}var Ar=[0,1,10,100,1e3,1e4,1e5];function fn(i,t){let e=Math.max(0,...t.pose_errors.map(n=>n.position??0));if(!(e>1e-9*i.scene))return 0;let s=Ar.filter(n=>n>=1&&n*e<.3*i.scene);return s.length?s[s.length-1]:1}var un=({width:i},t)=>b("text",{class:"bm-error-scale",x:i-8,y:16,"text-anchor":"end"},t===1?"errors to scale":`errors × ${t.toLocaleString("en").replaceAll(","," ")}`);var ht=i=>Math.round(Math.min(Math.max(i,-1e6),1e6)*100)/100;function ws(i,t,e){let s=i.length-1;if(s<1)return"";let n=(h,d)=>d<s?h[d+1]:e?h[1]:2*h[s]-h[s-1],o=(h,d)=>d>0?h[d-1]:e?h[s-1]:2*h[0]-h[1],r=`M${ht(i[0])} ${ht(t[0])}`,[a,l]=[(n(i,0)-o(i,0))/6,(n(t,0)-o(t,0))/6];for(let h=0;h<s;h+=1){let d=(n(i,h+1)-i[h])/6,p=(n(t,h+1)-t[h])/6;r+=`C${ht(i[h]+a)} ${ht(t[h]+l)} ${ht(i[h+1]-d)} ${ht(t[h+1]-p)} ${ht(i[h+1])} ${ht(t[h+1])}`,[a,l]=[d,p]}return r}var Lr=480,Nr=240,Tr=27,gn=11,zr=1.5,Oe=class{constructor(t,e,s){this.answers=t,this.playing=e,this.scene=s,this.factor=0,this.beyond=b("path",{class:"bm-curve bm-beyond"}),this.others=b("path",{class:"bm-curve bm-other"}),this.here=b("path",{class:"bm-curve bm-here"}),this.pivotPaths=[0,1].map(n=>b("path",{class:`bm-pivot-path bm-side${n}`})),this.paths=b("g",{class:"bs-paths","aria-hidden":"true"},this.others,this.beyond,...this.pivotPaths,this.here),this.feet=[0,1].map(n=>{let o=It();return o.classList.add(`bm-side${n}`),o}),this.rails=[0,1].map(n=>b("g",{class:`bm-rail bm-side${n}`},b("pat\
h",{class:"bm-ground"}),b("path",{class:"bm-ground bm-thin"}))),this.achieved=b("g",{class:"bs-achieved"}),this.arrows=b("path",{}),this.names=[0,1].map(n=>b("text",{class:`bm-name bm-side${n}`,"text-anchor":"middle"})),this.mechanism=null,this.holder=b("g",{class:"bs-mechanism"},...this.rails,...this.feet,this.achieved,b("g",{class:"bm-errors"},this.arrows)),this.labels=b("g",{class:"bs-dyad-names"},this.names),this.edges=b("g",{class:"bs-edges"}),s.layer("paths").append(this.paths),s.layer("mechanism").append(this.holder),s.layer("labels").append(this.labels,this.edges),s.hold?.(()=>this.points(
s.size.width<Lr&&!s.isWhole)),s.on("closer",()=>this.closer()),t.on("shown",()=>s.refit()),e.on("shape",()=>this.shape()),e.on("place",({place:n,drive:o})=>this.mechanism?.show(n,o)),s.on("view",()=>this.redraw()),s.names?.avoid(()=>this.obstacles()),this.redraw()}points(t=!1){let{linkage:e}=this.playing,{data:s}=this.answers;return is(s,e,e?re(s,e):[],{close:t})}closer(){let{selection:t,document:{poses:e}}=this.answers.store,s=t?.kind==="pose"?t.index:null,n=s===null?[]:e.slice(Math.max(0,s-1),s+2).map(o=>[o.x??0,o.y??0]);this.scene.closeUp(n.length>1?n:this.points(!0))}obstacles(){let{playing:{
linkage:t},scene:{view:e}}=this;return(t&&!t.gone?t.led.filter(n=>n.fixed_pivot):[]).map(({fixed_pivot:[n,o]})=>[e.X(n),e.Y(o)+gn,34,36])}enlarge(){let{linkage:t}=this.playing,{data:e}=this.answers,n=t?.pose_errors.length&&!(t.followed&&t.worst<pi*e.scene)?fn(e,t):0;this.factor=this.answers.isOld&&this.factor&&n?Math.min(this.factor,n):n}redraw(){this.shape(),this.playing.here&&this.playing.path&&this.mechanism?.show(this.playing.here.place,this.playing.here.drive)}shape(){let{playing:t,answers:e,scene:s}=this,{linkage:n,path:o}=t,{view:r}=s,a=!!n&&!n.gone;for(let h of[this.paths,this.holder,this.
labels,this.edges])f(h,"visibility",a?"visible":"hidden");if(!a)return;let l=o?Rr(o):[];if(this.enlarge(),this.curves(n,o,l,r),this.ground(n,l,r),this.outside(n,r),this.atPoses(n,r),!o){this.mechanism?.group.remove(),this.mechanism=null;return}this.mechanism?.fits(n)||(this.mechanism?.group.remove(),this.mechanism=new St(n),this.holder.append(this.mechanism.group)),this.mechanism.shape(e.data,n,r,l)}curves(t,e,s,n){let o=(c,m,g)=>f(c,"d",ws(m.map(([w])=>n.X(w)),m.map(([,w])=>n.Y(w)),g)),r=t.ways.filter(c=>c!==e);if(f(this.others,"d",r.map(c=>xn(c,n)).join("")),f(this.beyond,"d",e?xn(e,n):""),this.
pivotPaths.forEach((c,m)=>{let g=t.led[m];!e||!g.moving_pivot||g.kind==="PR"?f(c,"d",""):o(c,s.map(w=>$(w,g.moving_pivot)),e.round)}),!e){f(this.here,"d","");return}let{low:a,high:l}=this.playing.player.stretch,{length:h}=this.answers.data.chart,d=[],p=c=>(m=>[m.x,m.y])(W(t,e,c,h));d.push(p(a));for(let c=Math.floor(a)+1;c<l;c+=1)d.push([e.x[c],e.y[c]]);d.push(p(l)),o(this.here,d,e.round&&l-a>e.x.length-1-1e-6)}ground(t,e,s){let{scene:n}=this;t.led.forEach((o,r)=>{let[a,l,h]=[this.rails[r],this.feet[r],this.names[r]],d=o.kind==="PR"&&e.length>0;f(a,"display",d?"inline":"none"),f(l,"display",o.fixed_pivot?
"inline":"none"),f(h,"display",d||o.fixed_pivot?"inline":"none"),_(h,o.id);let p,c;if(d){let m=Yt(o,e,s);({x:p,y:c}=m),f(a,"transform",R(p,c,m.turned)),m.paths.forEach((g,w)=>f(a.children[w],"d",g)),f(a,"data-dyad",o.id)}else if(o.fixed_pivot)[p,c]=[s.X(o.fixed_pivot[0]),s.Y(o.fixed_pivot[1])],f(l,"transform",`translate(${x(p)} ${x(c)})`);else return;n.names.put(h,p,c+gn,o.id,ce(o.id,-Math.PI/2,Tr))})}outside(t,e){let s=t.led.flatMap((n,o)=>{let r=n.fixed_pivot&&os(e,n.fixed_pivot),a=r&&r.x>e.width/2;return r?[b("g",{class:`bm-to-far bm-side${o}`,"data-dyad":n.id,onclick:()=>this.scene.reveal(
n.fixed_pivot)},b("path",{class:`bm-far-mark bm-side${o}`,d:"M-9 -6L3 0L-9 6",transform:R(r.x,r.y,r.angle)}),b("text",{class:`bm-name bm-side${o}`,x:x(r.x+(a?-12:12)),y:x(E(r.y+4,14,e.height-24)),"text-anchor":a?"end":"start"},`${n.id} is outside`))]:[]});this.edges.replaceChildren(...s,...this.factor?[un(e,this.factor)]:[])}atPoses(t,e){let{achieved:s,answers:{data:n}}=this,o=t.pose_errors,r=Math.min(o.length,Nr),a=r>24?.6:1;for(;s.children.length>r;)s.lastChild.remove();for(;s.children.length<r;)s.append(b("g",{class:"bm-achieved"},b("path",{}),b("circle",{})));let l="";for(let h=0;h<r;h+=1){
let d=o[h],p=s.children[h];if(p.dataset.size!==String(a)&&(p.dataset.size=a,f(p.children[0],"d",ot(.72*zt*a)),f(p.children[1],"r",2.2*a)),d.x===null){f(p,"display","none");continue}f(p,"display","inline"),f(p.children[0],"display",n.poses[h]?.angle_deg===null?"none":"inline"),f(p,"transform",R(e.X(d.x),e.Y(d.y),S(d.angle_deg))),p.classList.toggle("bm-elsewhere",d.at!==this.playing.path),this.factor&&n.poses[h]&&(l+=Ir(e,n.poses[h],d,this.factor))}f(this.arrows,"d",l)}},Rr=i=>Array.from(i.x,(t,e)=>({x:t,y:i.y[e],a:i.angle[e]})),xn=(i,t)=>ws(Array.from(i.x,t.X),Array.from(i.y,t.Y),i.round);function Ir(i,t,e,s){
let n=i.X(t.x),o=i.Y(t.y),r=s*i.scale,a=r*(e.x-t.x),l=-r*(e.y-t.y),h=Math.hypot(a,l);if(!(h>=zr))return"";let d=Math.min(7,.5*h),p=a/h,c=l/h,m=`${x(n+a)} ${x(o+l)}`,g=w=>`L${x(n+a-d*(p-w*.5*c))} ${x(o+l-d*(c+w*.5*p))}`;return`M${x(n)} ${x(o)}L${m}${g(1)}M${m}${g(-1)}`}function wn(i,t){let e=Ht({poses:t}),s=t.map(l=>l.label),o=i.poses.length===s.length?`all ${e}s`:i.poses.length?`${e}${i.poses.length>1?"s":""} ${Xs(i.poses,s)}`:`no ${e}`,r=i.dead.filter(Boolean).length,a=i.round?"turns round":r===2?"between two dead points":r?"up to a dead point":"open";return`${o}; ${a}`}var _e=class{constructor(t,e){this.data=t,this.take=e,this.name=`bm-way-${Math.random().toString(36).slice(2)}`,this.element=u("fieldset",{class:"bm-ways"})}build(t,e){let s=(n,o)=>u("label",{},u("input",{type:"radio",name:this.name,value:o,checked:o===e,onchange:()=>this.take(o)}),u("span",{},u("b",{},Gs(n,t).replace("assembly ","")),` ${wn(n,this.data.poses)}`));this.element.replaceChildren(u("legend",{},"Assembly"),...t.ways.map(s)),O(this.element,"hidden",!t.ways.length||!!this.data.whole)}};var vn=7,jr=1e-6,Cr=5,Fr=2,Br=100,Se=13,Dr=18,Wr=1e-7,Yr=360,Kr=[.25,.5,1,2,4],qr=[["back","there and back"],["again","again and again"],["once","once"]],Ee=class{parts;steps;tick;wholeLabel;speeds;loops;real;realLabel;constructor(t,e,s){this.data=t,this.draw={show:e,rebuild:s},this.linkage=null,this.way=0,this.u=0,this.heading=1,this.speed=1,this.loop="back",this.isReal=!1,this.whole=!1,this.stretch={low:0,high:1,sense:1},this.playing=!1,this.remaining=null,this.element=this.controls()}get path(){return this.linkage?.ways[this.way]}get stop(){return Ht(this.data)}controls(){let t=(s,n,o,r)=>u(
"button",{type:"button",class:`bm-button ${s}`,"aria-label":o,title:o,onclick:r},n);this.button=t("bm-play","","Play",()=>this.play(!this.playing)),this.slider=u("input",{type:"range",class:"bm-slider",min:0,step:"any","aria-label":"Driver",oninput:()=>this.go(this.turned(Number(this.slider.value)))}),this.box=u("input",{type:"checkbox",onchange:()=>this.playWhole(this.box.checked)}),this.boxName=u("span",{},"Whole branch"),this.stops=b("svg",{class:"bm-stops","aria-hidden":"true"}),this.parts=["","","",""].map(s=>u("span",{},s)),this.readout=u("output",{class:"bm-now"},this.parts.flatMap((s,n)=>n?
[" ",s]:[s])),this.slider.addEventListener("keydown",s=>{let n={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,ArrowUp:1}[s.key];n&&(s.preventDefault(),this.step(s.shiftKey?10*n:n))});let e=(s,n,o)=>u("select",{class:"bm-pick","aria-label":s,title:s,onchange:r=>o(r.target.value)},n.map(([r,a])=>u("option",{value:r},a)));return this.steps=[t("bm-back","","",()=>this.toPose(-1)),t("bm-next","","",()=>this.toPose(1))],this.speeds=e("Speed",Kr.map(s=>[s,`${s} ×`]),s=>this.speed=Number(s)),this.speeds.value="1",this.loops=e("What comes after the last pose",qr,s=>this.takeLoop(s)),this.real=u("input",{type:"\
checkbox",onchange:()=>this.isReal=this.real.checked}),this.realLabel=u("label",{class:"bm-real",hidden:!0,title:"Move as the drive of the task moves it"},this.real,u("span",{},"As driven")),this.wholeLabel=u("label",{class:"bm-whole"},this.box,this.boxName),this.nameStops(),u("div",{class:"bm-controls"},u("div",{class:"bm-track"},this.slider,this.stops),u("div",{class:"bm-row"},this.button,this.steps[0],t("bm-small-step","‹","A small step back",()=>this.step(-1)),t("bm-small-step","›","A small step on",()=>this.step(1)),this.steps[1]),u("div",{class:"bm-more"},this.speeds,this.loops,this.
wholeLabel,this.realLabel),this.readout)}nameStops(){let{stop:t}=this,e=t[0].toUpperCase()+t.slice(1);[[`◀ ${e}`,`Previous ${t}`],[`${e} ▶`,`Next ${t}`]].forEach(([s,n],o)=>{_(this.steps[o],s),f(this.steps[o],"aria-label",n),O(this.steps[o],"title",n)}),O(this.wholeLabel,"title",`Play all that the driver reaches, not only from the first ${t} to the last`)}load(t){this.linkage=t,this.take(wt(t))}take(t){this.way=t,this.u=this.firstStop(),this.draw.rebuild()}get stopsOnWay(){return this.linkage.pose_errors.map((t,e)=>({...t,k:e})).filter(t=>t.way===this.way)}firstStop(){return this.stopsOnWay[0]?.
frame??0}rebuild(){let{path:t,slider:e}=this;t||this.play(!1),this.nameStops();for(let s of[e,this.button])O(s,"disabled",!t);this.linkage&&(this.stretch=jt(this.linkage,this.way,this.whole)),O(this.box,"disabled",!this.stretch.isApart),O(this.realLabel,"hidden",!this.timed),_(this.boxName,t?.round?"Whole turn":"Whole branch"),this.heading=1,this.u=E(this.u,this.stretch.low,this.stretch.high)}playWhole(t){this.whole=t,this.draw.rebuild()}drawStops(){let{stops:t,path:e}=this,{low:s,high:n}=this.stretch;if(t.replaceChildren(),!e)return;let o=Math.max(60,this.slider.clientWidth),r=9,a=g=>r+(this.
turned(g)-s)/(n-s)*(o-2*r),h=this.stopsOnWay.filter(g=>this.data.poses[g.k]).sort((g,w)=>a(g.frame)-a(w.frame)).map(g=>({...g,x:a(g.frame),pose:this.data.poses[g.k]})),d=yn(h.map(({x:g,pose:w})=>({x:g,text:dt(Ke(w),Dr)})),o,Cr),p=d.every(({at:g})=>g>=0)?d:yn(h.map(({x:g,pose:w})=>({x:g,text:w.label})),o,h.length>Br?1:Fr),c=Math.max(0,...p.map(({at:g})=>g)),m=(g,w,...k)=>b("g",{"data-pose":g+1},b("title",{},Ut(w)),...k);h.forEach(({k:g,x:w,pose:k},M)=>t.append(m(g,k,b("path",{d:`M${x(w)} 0V${4+Se*Math.max(0,p[M].at)}`})))),h.forEach(({k:g,pose:w},k)=>{let{at:M,middle:v,text:y}=p[k];M>=0&&t.append(
m(g,w,b("text",{x:x(v),y:14+Se*M,"text-anchor":"middle"},y)))}),f(t,"viewBox",`0 0 ${o} ${16+Se*c}`),f(t,"height",16+Se*c)}play(t){if(t&&!this.path||(this.remaining=null,t===this.playing&&this.isDressed)||(this.isDressed=!0,this.playing=t,f(this.readout,"aria-live",t?"off":"polite"),this.button.replaceChildren(Xr(t),t?"Pause":"Play"),f(this.button,"aria-label",t?"Pause":"Play"),this.button.title=t?"Pause (space)":"Play (space)",cancelAnimationFrame(this.tick),!t))return;let e=null,s=n=>{this.playing&&(e!==null&&this.advance(Math.min(.1,(n-e)/1e3)),e=n,this.playing&&(this.tick=requestAnimationFrame(
s)))};this.tick=requestAnimationFrame(s)}playOnce(){if(!this.path)return;let{low:t,high:e}=this.stretch;this.u=this.turned(t),this.heading=1,this.play(!0),this.remaining=(this.goesRound?1:2)*(e-t)}get goesRound(){return this.path.round&&this.stretch.high-this.stretch.low>this.path.x.length-1-jr}turned(t){let{low:e,high:s,sense:n}=this.stretch;return n<0?e+s-t:t}get timed(){let t=this.linkage?.followed?null:this.linkage?.loads;return t?.way===this.way&&!this.whole?t.timed:null}takeLoop(t){this.loop=t,this.heading=1}advance(t){let{low:e,high:s}=this.stretch;if(this.isReal&&this.timed)return this.
drive(t);let n=this.speed*t*(s-e)/(this.goesRound?vn:vn/2);if(this.remaining!==null&&(this.remaining-=n,this.remaining<=0)){this.play(!1),this.u=this.firstStop(),this.show();return}let o=this.turned(this.u)+this.heading*n,r=o>=s;r&&this.loop==="once"?(this.play(!1),this.u=this.turned(s)):this.goesRound?this.u=this.turned(kn(o,s)):r&&this.loop==="again"?this.u=this.turned(e):((r||o<=e)&&(this.heading=r?-1:1),this.u=this.turned(E(o,e,s))),this.show()}drive(t){let{timed:e}=this,{y:s}=e.time,n=Math.max(s[0],s[s.length-1]),o=Y(e.time,Q(this.path.drive,this.u))??0,r=o+this.speed*t;if(r>=n&&o<n)r=n;else{
if(r>=n&&this.loop==="once")return this.play(!1);r>=n&&(r=0)}this.u=xt(this.path.drive,Mi(e,r)??Q(this.path.drive,this.u)??0),this.show()}step(t){if(!this.path)return;let{low:e,high:s}=this.stretch,n=this.turned(this.u)+t*Math.max(.001,(s-e)/Yr);this.go(this.turned(this.goesRound?kn(n,s):n))}go(t){this.path&&(this.play(!1),this.u=E(t,this.stretch.low,this.stretch.high),this.show())}toPose(t){let e=this.linkage.pose_errors.map((o,r)=>({...o,k:r})).filter(o=>o.way!==null);if(!e.length)return;let s=this.atPose??(t>0?-1:this.data.poses.length),n=t>0?e.find(o=>o.k>s)??e[0]:[...e].reverse().find(o=>o.
k<s)??e[e.length-1];this.play(!1),n.way!==this.way&&(this.way=n.way,this.u=n.frame,this.draw.rebuild()),this.go(n.frame),this.atPose=n.k}placeAt(t){return W(this.linkage,this.path,t,this.data.chart.length)}nearest(t){let e=0,s=1/0;return this.data.poses.forEach((n,o)=>{let r=n.angle_deg===null?0:t.a-S(n.angle_deg),a=Math.hypot(t.x-n.x,t.y-n.y,this.data.chart.length*(r-2*Math.PI*Math.round(r/(2*Math.PI))));a<s&&([e,s]=[o,a])}),e}show(t=!0){let{path:e}=this;if(!e){for(let a of this.parts)a.textContent="";return}let s=this.placeAt(this.u),n=Q(e.drive,this.u),o=Q(e.transmission,this.u),r=this.atPose=
this.nearest(s);t&&(O(this.slider,"min",this.stretch.low),O(this.slider,"max",this.stretch.high),O(this.slider,"value",this.turned(this.u)),this.tell(s,n,o,r)),this.draw.show(s,n,o,r)}driverText(t){let{data:e,linkage:s}=this;return s.led[0].kind==="PR"?`${N(t,Nt(e))}${e.unit?` ${e.unit}`:""}`:`${s.crank??""}${N(t,1)}°`}tell(t,e,s,n){let{data:o,linkage:r}=this,a=o.unit?` ${o.unit}`:"",l=Nt(o),h=this.driverText(e),d=o.poses[n],p=r.pose_errors[n],c=p?.at===this.path&&Math.abs(p.frame-this.u)<1e-6,m=()=>`${q(Math.hypot(t.x-d.x,t.y-d.y))}${a} from ${Ut(d)}`,g=()=>`at ${Ut(d)}, ${p.said.position===
"exact"?"":"off by "}${Us(p.said.position,p.said.turned,a)}`,w=d?d.called?`${c?"at":"near"} ${d.called}`:c?g():m():"between the poses",k=this.isReal&&this.timed&&e!==null?Y(this.timed.time,e):null,v=[...this.path.told?.map(y=>this.toldOf(y))??[`driver ${h}${k===null?"":` at ${N(k,2)} s`}`,`body (${N(t.x,l)}, ${N(t.y,l)})${a}, ${N(((J(t.a)+180)%360+360)%360-180,2)}°`],`transmission ${s===null?"–":`${N(s,1)}°`}`,w];v.forEach((y,P)=>{let F=P+1<v.length?`${y} ·`:y;this.parts[P].textContent!==F&&(this.parts[P].textContent=F)}),f(this.slider,"aria-valuetext",`${v[0]}, ${v[3]}`)}toldOf({name:t,digits:e,
values:s,panel:n}){let o=n===void 0?null:Y(this.linkage.panels[n],ee(this.path.drive,this.u)),r=o===null?"":`, off by ${Math.abs(o)<Wr?"0":q(o)}°`;return`${t} ${N(ee(s,this.u),e)}°${r}`}};function yn(i,t,e){let s=Array(e).fill(-99);return i.map(({x:n,text:o})=>{let r=6.4*o.length,a=E(n-r/2,0,Math.max(0,t-r)),l=s.findIndex(h=>a>h+4);return l>=0&&(s[l]=a+r),{text:o,at:l,middle:a+r/2}})}var kn=(i,t)=>(i%t+t)%t;function Xr(i){return b("svg",{width:12,height:12,viewBox:"0 0 12 12","aria-hidden":"true"},b("path",{d:i?"M1 0h3.5v12H1zM7.5 0H11v12H7.5z":"M1 0l11 6l-11 6z"}))}function Mn(i,t){let e=0;window.addEventListener("beforeprint",()=>{i.play(!1),e=i.u;let[s]=i.linkage?i.stopsOnWay.map(({frame:n})=>n).sort((n,o)=>Math.abs(n-e)-Math.abs(o-e)):[];s!==void 0&&i.go(s)},{signal:t}),window.addEventListener("afterprint",()=>i.go(e),{signal:t})}function ys(i,t){if(i.kind==="PR")return ss(i,t);if(i.kind==="RP")return t.a+S(i.line.normal_deg);let[e,s]=$(t,i.moving_pivot);return Math.atan2(s-i.fixed_pivot[1],e-i.fixed_pivot[0])}function ks(i,t,e){if(i.kind==="PP"||t.kind==="PP")return null;let s=a=>{let[l,h]=D(a),d=Math.cos(e.a),p=Math.sin(e.a);return[d*l-p*h,p*l+d*h]};if(i.kind==="RP"&&t.kind==="RP")return 90;if(t.kind==="RP"){let a=$(e,i.moving_pivot),[l,h]=t.fixed_pivot;return vs(s(t),[l-a[0],h-a[1]])}let n=$(e,t.moving_pivot),o=t.kind==="PR"?D(t):[n[0]-t.fixed_pivot[0],n[1]-t.fixed_pivot[1]];if(i.kind==="RP")return vs(s(i),o);let r=$(
e,i.moving_pivot);return vs([n[0]-r[0],n[1]-r[1]],o)}var vs=(i,t)=>Math.atan2(Math.abs(i[0]*t[1]-i[1]*t[0]),Math.abs(i[0]*t[0]+i[1]*t[1]))*180/Math.PI;var Hr=3,$n=.381966011250105,Ur=24;function On(i,t){let e=[i.led[1],i.led[0]];if(e[0].kind==="PP"||!i.ways.length)return{...i,led:e,loads:null,ways:[],pose_errors:i.pose_errors.map(a=>({...a,way:null,frame:null,at:null}))};let s=[],n=Array(i.pose_errors.length).fill(null);for(let a of Gr(i.ways))for(let l of Vr(i,e[0],a,t)){let h=Jr(i,e,l,a,t),d=s.push(h)-1;i.pose_errors.forEach((p,c)=>{let m=n[c]||p.way===null?null:Qr(l,p,i.ways[p.way].x.length-1);m!==null&&(n[c]=[d,h.falls?l.stations.length-1-m:m],h.poses.push(c+1))})}let o=new Map;for(let a of s)a.branches=s.filter(l=>l.circuit===a.circuit).
length,o.set(a.circuit,(o.get(a.circuit)??0)+1),a.branch=o.get(a.circuit);let r=i.pose_errors.map((a,l)=>({...a,way:n[l]?.[0]??null,frame:n[l]?.[1]??null,at:n[l]?s[n[l][0]]:null,transmission_deg:a.x===null?null:ks(e[0],e[1],{x:a.x,y:a.y,a:a.angle_deg*Math.PI/180})}));return{...i,led:e,loads:null,ways:s,pose_errors:r}}function Gr(i){let t=[];for(let e of new Set(i.map(s=>s.circuit))){let s=i.map((p,c)=>({way:p,number:c})).filter(({way:p})=>p.circuit===e),n=({way:p,number:c},m)=>{let g=Array.from(p.x,(w,k)=>({way:c,u:k}));return m?g.reverse():g},[o,r]=s,a=(p,c)=>r&&o.way.dead[p]&&r.way.dead[c]&&
Zr(o.way,p,r.way,c);if(!r||!(a(0,0)||a(1,1))){for(let p of s)t.push({circuit:e,closed:p.way.round,stations:n(p,!1)});continue}let l=a(0,0)&&a(1,1),h=a(1,1),d=[...n(o,!h),...n(r,h).slice(1)];t.push({circuit:e,closed:l,stations:d})}return t}function Zr(i,t,e,s){let n=(p,c)=>[p.x[c],p.y[c]],o=(p,c)=>c?p.x.length-1:0,[r,a]=[o(i,t),o(e,s)],l=t?r-1:1,h=Math.hypot(...n(i,r).map((p,c)=>p-n(i,l)[c]));return Math.hypot(...n(i,r).map((p,c)=>p-n(e,a)[c]))<=Hr*h+1e-9*Math.hypot(...n(i,r))}function Vr(i,t,{circuit:e,closed:s,stations:n},o){let r=({way:v,u:y})=>W(i,i.ways[v],y,o),a=t.kind==="PR",l=null,h=v=>{
let y=ys(t,r(v));return!a&&l!==null&&(y-=2*Math.PI*Math.round((y-l)/(2*Math.PI))),y},d=n.map(v=>l=h(v)),p=n.length-1,c=v=>Math.sign(d[v+1]-d[v]),m=[];for(let v=1;v<p;v+=1)c(v)*c(v-1)<0&&m.push(v);if(s&&c(0)*c(p-1)<0&&m.push(0),!m.length)return[{circuit:e,round:s,dead:[!1,!1],stations:n}];let g=new Map(m.map(v=>[v,w(v)]));function w(v){let y=n[v],P=d[v]>d[v===0?1:v-1]?1:-1;l=d[v];let F=[v>0?v-1:p-1,v+1].map(I=>{let K=n[I];return K.way===y.way&&Math.abs(K.u-y.u)<1.5?[y.way,y.u,K.u]:[K.way,K.u,K.u<1.5?0:K.u+1]}),T=(I,K)=>P*h({way:I,u:K}),z={station:y,value:T(y.way,y.u)};for(let[I,K,Cs]of F){let[At,
Lt]=[Math.min(K,Cs),Math.max(K,Cs)];for(let Ds=0;Ds<Ur;Ds+=1){let[Ws,Ys]=[At+$n*(Lt-At),Lt-$n*(Lt-At)];T(I,Ws)<T(I,Ys)?At=Ws:Lt=Ys}let Fs={way:I,u:(At+Lt)/2},Bs=T(I,Fs.u);Bs>z.value&&(z={station:Fs,value:Bs})}return z.station}let k=(v,y)=>{let P=[];for(let T=v+1;T<y;T+=1)P.push(n[s?T%p:T]);let F=[v,y].map(T=>g.get(s?T%p:T)??n[T]);return[F[0],...P.filter(T=>!F.some(z=>z.way===T.way&&Math.abs(z.u-T.u)<.001)),F[1]]};if(m.sort((v,y)=>v-y),s){let v=[...m,m[0]+p];return v.slice(1).map((y,P)=>({circuit:e,round:!1,dead:[!0,!0],stations:k(v[P],y)}))}let M=[0,...m,p];return M.slice(1).map((v,y)=>({circuit:e,
round:!1,dead:[y>0,v<p],stations:k(M[y],v)}))}function Jr(i,t,e,s,n){let o=t[0].kind==="PR",r=e.stations.map(({way:d,u:p})=>({...W(i,i.ways[d],p,n)})),a=[];r.forEach((d,p)=>{let c=ys(t[0],d);!o&&p&&(c-=2*Math.PI*Math.round((c-a[p-1])/(2*Math.PI))),p&&(d.a-=2*Math.PI*Math.round((d.a-r[p-1].a)/(2*Math.PI))),a.push(c)});let l=a[a.length-1]<a[0];l&&[a,r].forEach(d=>d.reverse());let h=o?0:2*Math.PI*Math.round((a[0]+a[a.length-1])/(4*Math.PI));return{circuit:s.circuit,round:e.round,dead:l?[...e.dead].reverse():e.dead,poses:[],falls:l,drive:a.map(d=>o?d:J(d-h)),x:r.map(({x:d})=>d),y:r.map(({y:d})=>d),
angle:r.map(({a:d})=>d),transmission:r.map(d=>ks(t[0],t[1],d))}}function Qr({stations:i},{way:t,frame:e},s){for(let n=0;n+1<i.length;n+=1){let[o,r]=[i[n],i[n+1]];if(o.way!==t||r.way!==t){if(o.way===t&&Math.abs(o.u-e)<1e-9)return n;if(r.way===t&&Math.abs(r.u-e)<1e-9)return n+1;continue}let[a,l]=Math.abs(r.u-o.u)>s/2?[o,r].map(h=>h.u+(h.u<s/2?s:0)):[o.u,r.u];for(let h of[e,e+s]){if(h>=Math.min(a,l)-1e-9&&h<=Math.max(a,l)+1e-9)return a===l?n:n+(h-a)/(l-a);if(Math.max(a,l)<=s)break}}return null}var ta="(prefers-reduced-motion: reduce)",ea=1e-6,Pe=class extends gt{constructor(t,e){super(),this.store=t,this.answers=e,this.isOther=!1,this.here=null,this.player=new Ee(e.data,(s,n,o,r)=>this.placed({place:s,drive:n,transmission:o,near:r}),()=>this.rebuild()),this.assemblies=new _e(e.data,s=>this.player.take(s)),this.drivers=u("fieldset",{class:"bm-ways bs-drivers",hidden:!0}),this.note=u("p",{class:"bs-quiet bs-driver-note"}),this.element=u("div",{class:"bs-player"},this.player.element,u("div",{class:"bs-player-ways"},this.drivers,this.assemblies.element),this.note),this.words=new et(()=>this.
player.path&&this.player.show()),this.marks=new et(()=>this.player.drawStops()),e.on("answers shown placed",()=>this.load()),e.on("moved",()=>this.follow()),t.on("selection",()=>this.goToSelected()),t.on("state",()=>this.hush()),Mn(this.player),new ResizeObserver(()=>this.marks.ask()).observe(this.element),this.load()}get linkage(){return this.player.linkage}get path(){return this.player.path}load(){let t=this.answers.shown??null;if(t===this.base&&t){this.follow(),this.tellDriver();return}if(this.base=t,this.isOther=!1,this.at=null,this.dress(),!t){this.player.linkage=null,this.player.way=0,this.
player.play(!1);for(let e of[this.assemblies.element,this.drivers])O(e,"hidden",!0);_(this.note,""),this.element.classList.add("bs-empty"),this.emit("shape",!1);return}this.element.classList.remove("bs-empty"),this.player.load(this.driven()),this.goToSelected()}driven(){return this.isOther?On(this.base,this.answers.data.chart.length):this.base}driveBy(t){this.isOther=t,this.player.linkage=this.driven(),this.at=null,this.takeBest(),this.rebuild(),this.tellDriver()}takeBest(){this.player.way=wt(this.linkage),this.player.u=this.player.firstStop()}follow(){let{base:t,player:e}=this;if(!t)return;e.
linkage=this.driven();let s=this.at?.pose===void 0?null:e.linkage.pose_errors[this.at.pose];s&&s.way!==null?(e.way=s.way,e.u=s.frame):e.path?this.at&&(e.u=this.frameOf(e.path,this.at.drive)):e.linkage.ways.length&&this.takeBest(),e.rebuild(),this.emit("shape",!0),e.show(!1),this.words.ask(),this.marks.ask()}frameOf(t,e){if(e===null||this.linkage.led[0].kind==="PR")return xt(t.drive,e??t.drive[0]);let s=(t.drive[0]+t.drive[t.drive.length-1])/2;return xt(t.drive,e-360*Math.round((e-s)/360))}rebuild(){let{player:t}=this;t.rebuild(),this.assemblies.build(this.linkage,t.way),this.buildDrivers(),this.
emit("shape",!1),this.marks.ask(),t.show()}placed(t){this.here=t;let{path:e,u:s}=this.player,n=this.linkage.pose_errors.findIndex(o=>o.at===e&&Math.abs(o.frame-s)<ea);this.at={drive:t.drive,pose:n<0?void 0:n},this.emit("place",t)}goToSelected(){let{selection:t}=this.store,{player:e}=this;if(t?.kind!=="pose"||e.playing)return;let s=this.linkage?.pose_errors[t.index];if(!s||s.way===null)return;let n=s.way!==e.way;e.way=s.way,e.u=s.frame,n?this.rebuild():e.go(s.frame)}buildDrivers(){let{base:t}=this;if(O(this.drivers,"hidden",!t||!t.ways.length||t.led.some(({kind:n})=>n==="PP"||n==="crank")),this.
drivers.hidden)return;let e=`${t.id} ${t.led.map(n=>n.id)} ${this.isOther}`;if(e===this.driversKey)return;this.driversKey=e;let s=(n,o)=>u("label",{},u("input",{type:"radio",name:"bs-driver",checked:o===this.isOther,"data-driver":n.id,onchange:()=>this.driveBy(o)}),u("span",{},u("b",{},n.id),` ${{RR:"crank or rocker",PR:"slider on its rail",RP:"slot"}[n.kind]}`));this.drivers.replaceChildren(u("legend",{},"Driver"),s(t.led[0],!1),s(t.led[1],!0)),this.tellDriver()}tellDriver(){let{base:t}=this;if(!t?.drives||t.followed){_(this.note,"");return}let e=this.isOther?t.led[1]:t.led[0],s=t.dyads[0].id===
e.id?t.drives.first:t.drives.second,n=s.min_transmission_angle_deg.range,o=s.defects.length?s.defects.map(r=>r.message).join("; "):`${s.turns_fully?"turns fully":"reaches every pose"}${n===null?"":`, transmission angle ${N(n,1)}° or more between the poses`}`;_(this.note,`Driven by ${e.id}: ${o}.`)}dress(){this.driversKey=null}hush(){let t=this.store.state==="dragging"||this.player.playing;f(this.player.readout,"aria-live",t?"off":"polite")}};function _n(i,t,{player:e}){if(matchMedia(ta).matches)return;let s=!0;t.on("answers",()=>{s&&e.path&&(s=!1,e.playOnce())}),i.on("document selection",()=>{
s=!1,e.remaining!==null&&e.play(!1)})}function $s([i,t],{turn:e=0,scale:s=1,mirror:n=!1}){let[o,r]=Sn({turn:e,scale:s,mirror:n},[i,t]);return{turn:e,scale:s,mirror:n,x:i-o,y:t-r}}var Os=({turn:i})=>Number.isInteger(i/90)?(i/90%4+4)%4:NaN;function Sn(i,[t,e]){let s=Os(i),n=S(i.turn),[o,r]=Number.isNaN(s)?[Math.cos(n),Math.sin(n)]:[[1,0],[0,1],[-1,0],[0,-1]][s],a=i.mirror?-e:e;return[i.scale*(o*t-r*a),i.scale*(r*t+o*a)]}function sa(i,t){let[e,s]=Sn(i,t);return[vt(e+i.x),vt(s+i.y)]}var ia=(i,t)=>vt(i.turn+(i.mirror?-t:t));var na=(i,t)=>i&&L(i,Object.fromEntries(Object.entries(t).filter(([e])=>i[e]!==void 0).map(([e,s])=>[e,s(i[e])])));var Ms=(i,t)=>Os(i)%2===1?{x:"y",y:"x"}[t]??t:t;function oa(i,t){let e=o=>typeof o=="number"?vt(i.scale*o):o,s=t.axes!=="body",n=["x","y"].filter(o=>t[o]!==void 0).map(o=>[s?Ms(i,o):o,e(t[o])]);return{...L(t,{x:void 0,y:void 0}),...Object.fromEntries(n)}}function ra(i,t){let[e,s]=sa(i,[t.x??0,t.y??0]),n={x:e,y:s,...t.angle===void 0?{}:{angle:ia(i,t.angle)}};for(let o of["x","y"])t[o]===void 0&&delete n[Ms(i,o)];return{...L(t,{x:void 0,y:void 0,angle:void 0}),...n,...na({free:t.free,tolerance:t.tolerance},{free:o=>o.map(r=>Ms(i,r)),tolerance:o=>oa(i,o)})}}function En(i,t,e){let s=new Set(t);return aa(
{poses:i.poses.filter((n,o)=>s.has(o)),tolerance:i.tolerance},e)?null:L(i,{poses:i.poses.map((n,o)=>s.has(o)?ra(e,n):n)})}function aa({poses:i,tolerance:t},e){if(!Number.isNaN(Os(e)))return"";let s=r=>r&&r.axes!=="body"&&!!(r.x||r.y)&&!(r.x==="free"&&r.y==="free"),n=i.findIndex(r=>(r.free??[]).filter(a=>a!=="angle").length===1||s(r.tolerance)),o=n>=0?`pose ${n+1}`:s(t)?"the poses":"";return o&&`Only quarter turns are possible: ${o} may be missed along the axes of the ground, and they have no others.`}var Pn=46,la=27,Ae=24,ha=240,da=14,pa=14,ca=18,ma={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},An=(i,t)=>i+360*Math.round((t-i)/360),Ln=({poses:i},t)=>{let e=i.slice(1).reduce((s,{x:n,y:o},r)=>s+(Math.hypot(n-i[r].x,o-i[r].y)||0),0);return i.length<=Ae?1:Math.ceil(i.length/E(t*e/da,Ae,ha))};function _s({document:i,selection:t},e){let{poses:s}=i,n=s.length,o=[...s.keys()];if(n<=Ae)return o;let r=Ln(i,e),a=t?.kind==="pose"?t.indices??[t.index]:[];return o.filter(l=>l%r===0||l===n-1||a.includes(l))}var Le=class{constructor(t,e){this.store=t,this.scene=e,this.element=e.layer(
"poses"),this.names=e.layer("labels"),this.kept=new B(this.element,s=>this.make(s),(s,n)=>this.show(s,n)),this.labels=new B(this.names,()=>b("text",{class:"bs-pose-name"}),(s,n)=>this.showName(s,n)),t.on("document selection reference",()=>this.draw()),e.on("view",()=>this.draw()),e.on("marquee",([s,n,o,r])=>t.selectPoses([...t.document.poses.keys()].filter(a=>{let l=A(t.document,a);return l.x>=s&&l.x<=o&&l.y>=n&&l.y<=r}))),e.on("key",s=>t.selectedPoses.length>0&&this.key(s,t.selection.index,!1)),e.hold(()=>t.document.poses.map((s,n)=>A(t.document,n)).map(({x:s,y:n})=>[s,n])),e.on("click",()=>t.
select(null)),e.names.avoid(()=>this.obstacles()),this.draw()}get arm(){let{document:t}=this.store,{scale:e}=this.scene.view,s=_s(this.store,e).map(o=>A(t,o)),n=s.slice(1).map(({x:o,y:r},a)=>e*Math.hypot(o-s[a].x,r-s[a].y)).sort((o,r)=>o-r);return n.length?E(1.2*n[n.length>>1],la,Pn):Pn}draw(){this.length=this.scene.dragged?this.length??this.arm:this.arm;let t=_s(this.store,this.scene.view.scale).map(e=>[e,e]);this.kept.draw(t),this.labels.draw(t.length>Ae&&Tt(this.store.document)?[]:t)}make(t){let e=b("g",{class:"bs-origin","data-pose":t+1,tabindex:0,role:"button"},b("circle",{class:"bs-hold",
r:12}),b("circle",{class:"bs-dot",r:5.5})),s=b("g",{class:"bs-turn","data-turn":t+1,tabindex:0,role:"slider","aria-valuemin":-360,"aria-valuemax":360},b("circle",{class:"bs-hold",r:12}),b("circle",{class:"bs-tip",r:5})),n=b("g",{class:"bs-pose"},b("path",{class:"bs-axes"}),e,s);this.dragOrigin(e,t),this.dragTurn(s,t);for(let o of[e,s])o.addEventListener("focus",()=>this.touch(t));return e.addEventListener("keydown",o=>this.key(o,t,!1)),s.addEventListener("keydown",o=>this.key(o,t,!0)),n}show(t,e){let{store:s,scene:{view:n}}=this,{x:o,y:r,angle:a}=A(s.document,e),l=s.document.poses[e],h=s.selectedPoses.
includes(e),d=s.referenceIndex===e,p=s.document.length_unit??"",c=V(s.document,e),m=st(l);if(!Ft(t,[n,this.length,o,r,a,!!l.exact,l.name,c,p,h,d,m]))return;let[g,w,k]=t.children;f(t,"transform",R(n.X(o),n.Y(r),m?0:S(a)));for(let y of[g,k])f(y,"display",m?"none":"inline");t.classList.toggle("bs-point",m),f(g,"d",ot(this.length-8)),f(k,"transform",`translate(${x(this.length)} 0)`),t.classList.toggle("bs-selected",h),t.classList.toggle("bs-reference",d),t.classList.toggle("bs-exact",!!l.exact);let M=m?"Point":"Pose",v=l.name?`${M} ${e+1}, ${c}`:`${M} ${e+1}`;f(w,"aria-label",`${v}: x ${o} ${p}, y\
 ${r} ${p}, ${m?"angle free":`angle ${a}°`}. Drag, or use the arrow keys; Delete removes it.`),f(w,"aria-pressed",h),f(k,"aria-label",`Turn ${v}`),f(k,"aria-valuenow",a),f(k,"aria-valuetext",`${a}°`)}obstacles(){let{store:t,scene:{view:e},length:s}=this,n=[];for(let o of _s(t,e.scale)){let{x:r,y:a,angle:l}=A(t.document,o),h=S(l),[d,p]=[Math.cos(h),Math.sin(h)],c=(m,g,w)=>n.push([e.X(r)+m*d-g*p,e.Y(a)-m*p-g*d,w,w]);if(c(0,0,13),!st(t.document.poses[o])){c(s,0,12),c(Dt,-Dt,12);for(let m of[.35,.7])c(m*s,0,6);for(let m of[.3,.6])c(0,m*(s-8),6)}}return n}showName(t,e){let{store:s,scene:n}=this,{
view:o}=n,{x:r,y:a,angle:l}=A(s.document,e),h=s.isOnBody&&e===s.referenceIndex,d=`${dt(V(s.document,e),ca)}${h?": drawn here":""}`;t.classList.toggle("bs-reference",e===s.referenceIndex),Ft(t,[o,r,a,l,d])&&(_(t,d),n.names.put(t,o.X(r),o.Y(a),d,ce(d,S(l+215),pa,n.names.areMany)))}set(t,e,s){this.store.edit(n=>Ge(n,t,ni(n.poses[t],e)),{gesture:s})}touch(t){let{store:e,scene:s}=this;s.pressed?.shiftKey||(e.selectedPoses.includes(t)?e.selectPoses(e.selectedPoses,t):e.select({kind:"pose",index:t}))}click(t,e){return t.shiftKey?this.store.selectAlso(e):(this.store.select({kind:"pose",index:e}),this.
openField(e))}heldWith(t){let{store:e}=this;return e.selectedPoses.includes(t)||e.select({kind:"pose",index:t}),e.selectedPoses}openField(t){let{store:e,scene:s}=this,n=()=>e.selectedPoses.includes(t),o=st(e.document.poses[t]);s.field.open({name:`pose ${t+1}`,kind:"pose",at:()=>n()&&Object.values(A(e.document,t)).slice(0,2),values:()=>A(e.document,t),fields:[["x","x","length"],["y","y","length"],...o?[]:[["angle","angle °","angle"]]],set:r=>this.set(t,r,null)})}moveAll(t,e,s,n){let o=En(t,e,s);o&&this.store.edit(r=>({...r,poses:o.poses}),{gesture:n})}dragOrigin(t,e){let{store:s,scene:n}=this,
o,r,a,l,h,d;n.drag(t,{start:p=>{let{x:c,y:m}=A(s.document,e);o=Symbol("move a pose"),h=[c,m],r=[c-p.x,m-p.y],a=s.document,l=Tt(a)?Ln(a,n.view.scale):1,d=this.heldWith(e),this.openField(e)},move:(p,c)=>{let m=n.snap.point([p.x+r[0],p.y+r[1]],{event:c,from:h,skip:g=>d.some(w=>g.endsWith(`pose ${w}`))});d.length>1?this.moveAll(a,d,{turn:0,scale:1,mirror:!1,x:m[0]-h[0],y:m[1]-h[1]},o):l>1?this.bend(a,e,l,[m[0]-h[0],m[1]-h[1]],o):this.set(e,{x:m[0],y:m[1]},o)},cancel:()=>s.abandon(o),click:p=>this.click(p,e)})}bend({poses:t,path:e},s,n,[o,r],a){let l=t.length,h=t.map((d,p)=>{let c=e?.closed?Math.min(
Math.abs(p-s),l-Math.abs(p-s)):Math.abs(p-s),m=1-c/n;return m>0?{...d,x:this.scene.rounded(d.x+m*o),y:this.scene.rounded(d.y+m*r)}:d});this.store.edit(d=>({...d,poses:h}),{gesture:a})}dragTurn(t,e){let{store:s,scene:n}=this,o,r,a,l,h=d=>{let{x:p,y:c}=A(s.document,e);return J(Math.atan2(d.y-c,d.x-p))};n.drag(t,{start:d=>{o=Symbol("turn a pose"),a=s.document,l=this.heldWith(e),r=A(a,e).angle-h(d),this.openField(e)},move:(d,p)=>{let{x:c,y:m,angle:g}=A(s.document,e),w=n.snap.angle(An(h(d)+r,g),[d.x,d.y],{event:p,skip:e});l.length>1?this.moveAll(a,l,$s([c,m],{turn:w-A(a,e).angle}),o):this.set(e,{angle:w},
o)},cancel:()=>s.abandon(o),click:d=>this.click(d,e)})}key(t,e,s){let{store:n,scene:o}=this,r=ma[t.key],a=n.selectedPoses.includes(e)?n.selectedPoses:[e];if(t.ctrlKey||t.metaKey)return!1;if(r){t.repeat||(this.keyed=Symbol("keys"));let{x:l,y:h,angle:d}=A(n.document,e),p=Bt(t,s?1:o.step);a.length>1&&s?this.moveAll(n.document,a,$s([l,h],{turn:p*(r[0]===0?r[1]:-r[0])}),this.keyed):a.length>1?this.moveAll(n.document,a,{turn:0,scale:1,mirror:!1,x:p*r[0],y:p*r[1]},this.keyed):s?this.set(e,{angle:H(d,p*(r[0]===0?r[1]:-r[0]))},this.keyed):this.set(e,{x:H(l,p*r[0]),y:H(h,p*r[1])},this.keyed)}else if(t.key===
"Delete"||t.key==="Backspace"){n.edit(d=>ti(d,a));let l=n.document.poses.length,h=Math.min(a.length>1?a[0]:e,l-1);n.select(l?{kind:"pose",index:h}:null),this.focus(h)}else return!1;return t.preventDefault(),!0}focus(t){this.element.querySelector(`[data-pose="${t+1}"]`)?.focus({preventScroll:!0})}};var Ne=class{constructor(t,e){this.store=t,this.scene=e,this.name="pose",this.gesture=null,this.hint="Click where the pose is to stand, and click again to turn it. Escape ends."}click(t,e){let{store:s,scene:n}=this;if(this.gesture){this.turn(t,e),this.gesture=null;return}let[o,r]=n.snap.point([t.x,t.y],{event:e});this.gesture=Symbol("add a pose");let a=s.document.poses.findLast(l=>Number.isFinite(l.angle))?.angle??0;s.edit(l=>Qs(l,{x:o,y:r,angle:a}),{gesture:this.gesture}),s.select({kind:"pose",index:s.document.poses.length-1})}hover(t,e){this.gesture&&t?this.turn(t,e):t&&this.scene.snap.point(
[t.x,t.y],{event:e})}turn(t,e){let{store:s,gesture:n}=this,o=s.document.poses.length-1,{x:r,y:a,angle:l}=A(s.document,o);if(Math.hypot(t.x-r,t.y-a)*this.scene.view.scale<6)return;let d=this.scene.snap.angle(An(J(Math.atan2(t.y-a,t.x-r)),l),[t.x,t.y],{event:e,skip:o});s.edit(p=>Ge(p,o,{angle:d}),{gesture:n})}key(t){return t.key!=="Escape"?!1:(this.gesture&&this.store.abandon(this.gesture),this.gesture=null,this.scene.use(null),!0)}};var ba=22,Ss=10,Es=9,fa={fixed_pivot:"Fixed pivot",moving_pivot:"Moving pivot","rail through":"Rail through","rail travel":"Rail travel","slot through":"Slot through","slot travel":"Slot travel"};function Nn(i,{table:t,key:e}){return`${fa[e]}${it(i).length>1?` of dyad ${t+1}`:""}`}function Et(i){return i.box?{shape:"box",points:i.box}:i.polygon?{shape:"polygon",points:i.polygon}:null}var Te=class{onjudged;constructor(t,e){this.store=t,this.scene=e,this.shapes=new Map,e.layer("regions").append(b("defs",{},b("pattern",{id:"bs-hatch",width:Es,height:Es,patternUnits:"userSpaceOnUse",patternTransform:"\
rotate(45)"},b("path",{class:"bm-hatch",d:`M0 0V${Es}`})))),this.regions=new B(b("g"),(s,n)=>this.makeRegion(n),s=>this.shapes.get(s).draw()),this.footprint=new B(b("g"),()=>this.makeFootprint(),s=>this.shapes.get(s).draw()),this.limits=new B(b("g"),(s,n)=>this.makeLimit(n),s=>this.shapes.get(s).draw()),this.names=new B(b("g",{class:"bs-region-names","aria-hidden":"true"}),()=>b("text",{}),(s,n)=>this.showName(s,n)),e.layer("regions").append(this.regions.group,this.footprint.group),e.layer("limits").append(this.limits.group),e.layer("labels").append(this.names.group),t.on("document",()=>this.judge(
t.state==="dragging"&&!this.isOther())),t.on("selection reference",()=>this.draw()),t.on("solved followed chosen placed",()=>this.judge()),e.on("view",()=>this.draw()),e.hold(()=>X(t.document).filter(({shape:s})=>s!=="line").flatMap(s=>this.corners(s))),e.hold(()=>j(t.document).map(Et).filter(Boolean).flatMap(({shape:s,points:n})=>C(s,n)),!0),this.judge()}place({key:t}){return nt(t)?ve(this.store):_t}corners(t){return C(t.shape,t.points).map(e=>$(this.place(t),e))}isOther(){let{body:t,keep_out:e,surroundings:s}=this.store.document;return[t,e,s].some((o,r)=>o!==this.judged?.[r])}judge(t=!1){let{
document:e,solved:s}=this.store,n=ue(this.store);this.broken=n?.led?Ui(e,n,s?.scene??1):null,t||(this.judged=[e.body,e.keep_out,e.surroundings],this.touched=n?.led?Zi(e,n,Z(e)):null),this.draw(),this.onjudged?.()}said(t,e){return/^(rail|slot)/.test(e)?null:this.broken?.[t]?.filter(s=>s.key===e).map(s=>Gi(s,this.store.document.length_unit))??null}draw(){let{document:t}=this.store,e=j(t),s=X(t),{footprint:n}=t.requirements??{};this.regions.draw(e.map((o,r)=>[r,r]).filter(([o])=>Et(e[o]))),this.limits.draw(s.map(o=>[`${o.table} ${o.key}`,o])),this.footprint.draw(n?[["footprint",n]]:[]);for(let[o,
r]of this.shapes)o.parentNode||(r.clear(),this.shapes.delete(o));this.names.draw([...e.map((o,r)=>[`region ${r}`,o.name&&Et(o)?{text:o.name,at:ua(C(...Object.values(Et(o))))}:null]),...s.map(o=>[`limit ${o.table} ${o.key}`,{text:Nn(t,o),at:Tn(this.corners(o),nt(o.key)),off:nt(o.key)?Ss:-Ss,width:zn(this.corners(o))}]),["footprint",n?{text:"Footprint",at:Tn(n.polygon??C("box",n.box),!0),off:Ss,width:zn(n.polygon??n.box)}:null]].filter(([,o])=>o))}kept(t){return this.shapes.set(t.element,t),t.element}makeRegion(t){let{store:e}=this,s=new at(this.scene,{className:"bs-region",what:()=>{let o=j(e.document)[t];
return{...Et(o),place:_t,name:o.name?`Keep out: ${o.name}`:`Region ${t+1} to keep out of`,selected:e.selection?.kind==="region"&&e.selection.index===t,state:this.touched?this.touched[t]?"broken":"met":"",data:{region:t}}},set:(o,r)=>e.edit(a=>si(a,t,Qt(Et(j(a)[t]).shape,o)),{gesture:r}),remove:()=>this.removeRegion(t),select:()=>e.select({kind:"region",index:t}),abandon:o=>e.abandon(o)});s.element.insertBefore(b("path",{class:"bs-hatched",fill:"url(#bs-hatch)"}),s.area);let n=s.draw.bind(s);return s.draw=()=>{n(),s.element.querySelector(".bs-hatched").setAttribute("d",s.line.getAttribute("d"))},
this.kept(s)}removeRegion(t){this.store.edit(e=>ii(e,t)),this.store.select(null),this.scene.svg.focus({preventScroll:!0})}makeLimit({table:t,key:e}){let{store:s}=this,n=()=>this.place({key:e}),o=()=>X(s.document).findIndex(r=>r.table===t&&r.key===e);return this.kept(new at(this.scene,{className:`bs-limit bs-${e.replace(/[_ ]/,"-")}`,what:()=>{let r=o(),a=X(s.document)[r],l=this.said(t,e);return{...a,place:n(),name:`Limit: ${Nn(s.document,a)}`,selected:s.selection?.kind==="limit"&&s.selection.index===r,state:l?l.length?"broken":"met":"",data:{limit:r,plane:nt(e)?"M":"F"}}},set:(r,a)=>s.edit(l=>Jt(
l,t,{[e]:Qt(Object.keys(Gt(it(l)[t],e))[0],r)}),{gesture:a}),remove:()=>this.removeLimit(t,e),select:()=>s.select({kind:"limit",index:o()}),abandon:r=>s.abandon(r)}))}removeLimit(t,e){this.store.edit(s=>Jt(s,t,{[e]:void 0})),this.store.select(null),this.scene.svg.focus({preventScroll:!0})}makeFootprint(){let{store:t}=this,e=()=>Object.keys(t.document.requirements.footprint)[0];return this.kept(new at(this.scene,{className:"bs-footprint",what:()=>({shape:e(),points:t.document.requirements.footprint[e()],place:_t,name:"Footprint: holds all pivots",selected:t.selection?.kind==="footprint",data:{footprint:""}}),
set:(s,n)=>t.edit(o=>te(o,"footprint",{[e()]:s}),{gesture:n}),remove:()=>{t.edit(s=>te(s,"footprint",void 0)),t.select(null)},select:()=>t.select({kind:"footprint",index:0}),abandon:s=>t.abandon(s)}))}showName(t,{text:e,at:[s,n],off:o,width:r}){let{scene:a}=this,{view:l}=a,h=dt(e,ba);_(t,h),f(t,"class",o?"bs-limit-name":"bs-region-name"),a.names.put(t,l.X(s),l.Y(n),h,o?Ci(o,l.scale*(r??0)):[[0,0,0]],!!o)}regionTool(t){let{store:e}=this;return new lt(this.scene,{shape:t,name:`region ${t}`,place:()=>_t,done:s=>{e.edit(n=>ei(n,{[t]:s})),e.select({kind:"region",index:j(e.document).length-1})}})}limitTool(t,e,s){
let{store:n}=this;return new lt(this.scene,{shape:s,name:`limit ${t} ${e} ${s}`,place:()=>this.place({key:e}),at:nt(e)?cs(n):"",done:o=>{n.edit(r=>Jt(r,t,{[e]:Qt(s,o)})),n.select({kind:"limit",index:X(n.document).findIndex(r=>r.table===t&&r.key===e)})}})}footprintTool(t){let{store:e}=this;return new lt(this.scene,{shape:t,name:`footprint ${t}`,place:()=>_t,done:s=>{e.edit(n=>te(n,"footprint",{[t]:s})),e.select({kind:"footprint",index:0})}})}};function ua(i){let[t,e,s,n]=G(i);return[(t+s)/2,(e+n)/2]}function Tn(i,t){let[e,s,n,o]=G(i);return[(e+n)/2,t?o:s]}function zn(i){let[t,,e]=G(i);return Number.
isFinite(e-t)?e-t:0}var ze=300,Ps=[110,180],As=16,ga=3,Pt=class{constructor(){this.svg=b("svg",{class:"bm-portrait",viewBox:`0 0 ${ze} ${Ps[0]}`,"aria-hidden":"true"})}draw(t,e){if(this.ways===e.ways||!e.ways.length)return;this.ways=e.ways,this.linkage=e;let s={...t,...e.picture,loads:null,keep_out:[]},n=this.index=wt(e),o=e.ways[n],r=jt(e,n),a=es(s,e,o,r),l=r.sense<0?[r.high,r.low]:[r.low,r.high],h=ae(s,e,a),d=ae(s,e,a,{close:!0}),p=Rn(h)>ga*Rn(d)?d:h,[c,m,g,w]=p,k=Math.round(E((w-m)/(g-c)*(ze-2*As)+2*As,Ps[0],Ps[1])),M=Ct(p,ze,k,As);f(this.svg,"viewBox",`0 0 ${ze} ${k}`),Object.assign(this.svg.dataset,{scale:M.
scale,left:M.left,top:M.top}),this.length=t.chart.length;let v=z=>W(e,o,z,t.chart.length),y=z=>{let I=new St(e);return I.shape(s,e,M,a),I.show(v(z),Q(o.drive,z)),I},P=y(l[1]);P.group.classList.add("bm-portrait-last"),this.now=y(l[0]),this.now.group.classList.add("bm-portrait-now");let F=b("path",{class:"bm-curve bm-here",d:ie(a.map(({x:z,y:I})=>[z,I]),M)}),T=s.poses.map(({x:z,y:I})=>b("circle",{class:"bm-portrait-pose",cx:x(M.X(z)),cy:x(M.Y(I)),r:4}));this.svg.replaceChildren(...e.led.map(z=>xa(z,a,M)).filter(Boolean),F,P.group,...T,this.now.group)}show(t){if(!this.now||!this.linkage)return;let e=t?.
way??this.index,s=jt(this.linkage,e),n=t?.u??(s.sense<0?s.high:s.low),o=this.linkage.ways[e];this.now.show(W(this.linkage,o,n,this.length??1),Q(o.drive,n))}},Rn=([i,t,e,s])=>Math.max(e-i,s-t);function xa(i,t,e){if(i.kind==="PR"){let{x:n,y:o,turned:r,paths:a}=Yt(i,t,e);return b("g",{class:"bm-rail",transform:R(n,o,r)},a.map(l=>b("path",{class:"bm-ground",d:l})))}if(!i.fixed_pivot)return null;let s=It();return f(s,"transform",`translate(${x(e.X(i.fixed_pivot[0]))} ${x(e.Y(i.fixed_pivot[1]))})`),s}var wa={mm:.1,cm:.01,m:1e-4,um:1,in:.005,ft:5e-4};var va=.02,ya=({said:i},t)=>i.worst==="-"?"–":[i.worst==="exact"?"nothing":Kt(i.worst,t),i.angle&&!["-","exact","free"].includes(i.angle)?i.angle:null].filter(Boolean).join(", "),Kt=(i,t)=>`${i}${t.unit?` ${t.unit}`:""}`,ft=(i,t)=>(i.quality?.extent??NaN)*t.span;function ka({quality:i},t){let e=i?.sensitivity??NaN,s=wa[t.unit]??10**Math.round(Math.log10(t.span/1e3));return[`${Kt(q(s),t)} of error`,Number.isFinite(e)?`moves it ${Kt(q(s*e),t)}`:"–"]}var jn=(i,t)=>[["worst","misses by",ya(i,t)],["least","transmits",Ls(i.said.transmission)],["size","size",Number.isFinite(ft(i,t))?Kt(q(ft(i,t)),
t):"–"],["sensitivity",...ka(i,t)]],Ls=i=>({"-":"–","–":"–","0°":"down to 0°"})[i]??`${i} or more`;function Cn(i,t,e){if(!i.usable||!t?.usable||t.id===i.id)return"";let s=ft(i,e)-ft(t,e),n=In(i)-In(t),o=(a,l,h)=>a>0?l:h,r=[Math.abs(s)>va*ft(t,e)?`${Kt(q(Math.abs(s)),e)} ${o(s,"larger","smaller")}`:"",Math.abs(n)>=.5?`transmits ${N(Math.abs(n),0)}° ${o(n,"more","less")}`:""].filter(Boolean);return r.length?`Than ${t.id}: ${r.join(", ")}`:""}var In=i=>i.least??i.min_transmission_angle_deg?.range??NaN;function Ns(i){return i.card?.facts?i.card.verdict:i.usable?i.shortcomings?.length&&!i.
followed?`✓ usable, but ${i.shortcomings.join("; ")}`:"✓ usable":"✕ not usable"}var Re=class{constructor(t,e){this.name=u("b",{}),this.type=u("span",{class:"bm-type"}),this.was=u("span",{class:"bs-was"}),this.verdict=u("span",{class:"bm-verdict"}),this.portrait=new Pt,this.figures=u("dl",{}),this.differs=u("span",{class:"bm-differs"}),this.links=u("span",{class:"bm-lengths"}),this.quiet=u("span",{class:"bm-quiet"}),this.reason=u("span",{class:"bm-reason"}),this.help=u("span",{class:"bs-help"}),this.element=u("button",{type:"button",class:t,"aria-pressed":"false",onclick:e},u("span",{class:"\
bm-choice-head"},this.name," ",this.type," ",this.was),this.portrait.svg,this.verdict,this.figures,this.differs,this.links,this.quiet,this.reason,this.help)}show(t,e,{name:s=e.id,was:n="",verdict:o=Ns(e),figures:r,differs:a="",links:l="",quiet:h="",reason:d="",help:p=""}){this.portrait.draw(t,e);for(let[g,w]of[[this.name,s],[this.type,e.type],[this.was,n],[this.verdict,o],[this.differs,a],[this.links,l],[this.quiet,h],[this.reason,d],[this.help,p]])_(g,w);let c=this.figures.children,m=r.map(([g,w])=>`${g} ${w}`).join();m!==this.names&&this.figures.replaceChildren(...r.map(([g,w])=>u("div",{},u(
"dt",{},w),u("dd",{"data-figure":g})))),this.names=m,r.forEach(([,,g],w)=>_(c[w].lastChild,g))}};var Ie=class{constructor(t){this.card=new Re("bs-card-main",()=>t.choose(this.id)),this.main=this.card.element,this.pin=u("button",{type:"button",class:"bs-small","aria-pressed":"false",title:"Pin two, and they move beside each other",onclick:()=>t.pin(this.id)},"Pin"),this.improve=u("button",{type:"button",class:"bs-small",onclick:()=>t.improve(this.id)},"Look near it"),this.letGo=u("button",{type:"button",class:"bs-small",onclick:()=>t.letGo()}),this.better=u("ul",{class:"bs-better","aria-live":"polite"}),this.element=u("article",{class:"bs-card bm-choice"},this.main,u("div",{class:"bs-card-\
tools"},this.pin,this.improve,this.letGo),this.better)}show(t,{data:e,best:s,old:n,chosen:o,pinned:r}){let{said:a}=t,{classList:l}=this.element,h=t.id===tt;(this.id!==t.id||n)&&this.better.replaceChildren(),this.id!==t.id&&(this.id=t.id,f(this.element,"data-linkage",t.id));let d=t.usable||t.gone?"":t.followed?t.reason??"":a.reasons.join("; ");this.card.show(e,t,{name:h?t.called:t.id,was:Ma(t),verdict:t.gone?"✕ gone":Ns(t),figures:Ts(t,e),differs:n||h||t.gone?"":Cn(t,s,e),quiet:t.gone??(t.usable&&t.change||a.rounded||""),reason:d,help:d&&a.help&&!t.followed?`What would help: ${a.help}.`:""}),
l.toggle("bm-good",t.usable&&!t.gone),l.toggle("bm-bad",!t.usable||!!t.gone),l.toggle("bs-gone",!!t.gone),l.toggle("bs-old",n||!!t.followed),l.toggle("bs-chosen",o),Fn(this.main,o),Fn(this.pin,r),_(this.pin,r?"Pinned":"Pin"),O(this.pin,"hidden",h),O(this.improve,"hidden",h||t.usable||n||!!t.gone),O(this.letGo,"hidden",!h),_(this.letGo,t.called==="By hand"?"Let go of the pivots":"Put it away");for(let p of[this.pin,this.improve])$a(p,t.id)}tellBetter(t){this.better.replaceChildren(...t.map(e=>u("li",{},e)))}},Ts=(i,t)=>jn(i,t).map(([e,s,n])=>e==="worst"&&t.isPath?[e,"path error",ci(i,t)]:e==="w\
orst"&&i.followed?[e,s,Je(i,t).replace("exact","nothing")]:e==="least"&&i.followed?[e,s,Ls(mi(i))]:[e,s,n]);function Ma({was:i,shift:t,isNew:e,followed:s}){if(e&&!i)return"new";let n=t&&!s?`moved ${(100*t).toFixed(1)} %`:"";return[i?`was ${i}`:"",n].filter(Boolean).join(", ")}function Fn(i,t){f(i,"aria-pressed",!!t)}function $a(i,t){f(i,"aria-label",`${i.textContent}: ${t}`)}var Oa=(i,t)=>i.pose_errors.map((e,s)=>({k:s,way:e.way,frame:e.frame})).filter(e=>e.way===t).sort((e,s)=>e.frame-s.frame);function Bn(i,t,e){let s=Oa(i,t);if(!s.length)return null;if(s.length===1)return{from:s[0].k,to:s[0].k,share:0};let n=0;for(;n+2<s.length&&s[n+1].frame<=e;)n+=1;let[o,r]=[s[n],s[n+1]],a=r.frame-o.frame,l=a>0?(e-o.frame)/a:0;return{from:o.k,to:r.k,share:Math.min(Math.max(l,-1),2)}}var je=i=>!!i&&i.way!==null;function Dn(i,t){if(!t)return null;let[e,s]=[t.from,t.to].map(l=>i.pose_errors[l]);if(!je(e)||!je(s)||e.way!==s.way){let[l,h]=t.share<.5?[e,s]:[s,e],d=je(l)?l:je(h)?h:null;
return d&&{way:d.way,u:d.frame}}let n=i.ways[e.way],o=n.x.length-1,r=s.frame-e.frame;n.round&&Math.abs(r)>o/2&&(r-=Math.sign(r)*o);let a=e.frame+t.share*r;return{way:e.way,u:n.round?(a%o+o)%o:Math.min(Math.max(a,0),o)}}function _a(i,t,e){let s=[i,t],n=a=>a.every(Number.isFinite)&&a[0]!==a[1]?a[0]<a[1]?0:1:null,o={worst:a=>a.worst,least:a=>-(a.least??NaN),size:a=>ft(a,e),sensitivity:a=>a.quality?.sensitivity},r=s.map(a=>Ts(a,e));return[{name:"verdict",texts:s.map(a=>a.gone?"gone":a.usable?"usable":"not usable"),better:n(s.map(a=>a.usable?0:1))},...r[0].map(([a,l,h],d)=>({name:l,texts:[h,r[1][d][2]],better:n(s.map(p=>o[a](p)??NaN))}))]}var Ce=class{constructor(t,e,s){this.store=t,this.answers=e,this.playing=s,this.portraits=[0,1].map(()=>new Pt),this.names=[0,1].map(()=>u("h3",{})),this.places=[0,1].map(()=>u(
"p",{class:"bs-quiet"})),this.table=u("div",{class:"bm-scroll",tabindex:0,role:"region","aria-label":"Both linkages in numbers"}),this.button=u("button",{type:"button",class:"bm-button",onclick:()=>s.player.play(!s.player.playing)},"Play both"),this.finish=u("button",{type:"button",class:"bs-small",onclick:()=>this.pair.forEach(({id:n})=>t.pin(n))},"End the comparison"),this.element=u("div",{class:"bs-compare",hidden:!0,"aria-label":"The two that are pinned",role:"group"},u("div",{class:"bs-beside"},[0,1].map(n=>u("div",{},this.names[n],this.portraits[n].svg,this.places[n]))),u("div",{class:"b\
s-tool"},this.button," ",this.finish),this.table),this.pace=new et(()=>this.build(),()=>rs(this.element)),e.on("answers moved",()=>this.pace.ask()),t.on("pinned",()=>this.build()),s.on("place",()=>this.show()),Ti(this.element,()=>this.pace.ask())}get pair(){let t=[...this.store.pinned].map(e=>this.answers.get(e)).filter(e=>e?.ways.length);return t.length>1?t.slice(0,2):[]}build(){let{pair:t,answers:{data:e}}=this;O(this.element,"hidden",!t.length),t.length&&(t.forEach((s,n)=>{this.names[n].textContent=`${s.id}: ${s.type}`,this.portraits[n].draw(e,s)}),this.buildTable(_a(t[0],t[1],e)),this.show())}buildTable(t){
let e=this.answers.isOld?"bs-old":null;this.table.replaceChildren(u("table",{class:"bs-compared"},u("caption",{},"Both linkages in numbers; the better one of each row is bold"),u("thead",{},u("tr",{},u("th",{scope:"col"},""),this.pair.map(({id:s})=>u("th",{scope:"col"},s)))),u("tbody",{},t.map(({name:s,texts:n,better:o})=>u("tr",{class:/size|error/.test(s)?e:null},u("th",{scope:"row"},s),n.map((r,a)=>u("td",{class:"bm-words"},o===a?u("b",{},r):r)))))))}show(){let{playing:{linkage:t,player:e}}=this;if(this.element.hidden||!t||!rs(this.element))return;let s=Bn(t,e.way,e.u);this.pair.forEach((n,o)=>{
let r=Dn(n,s),a=r?n.ways[r.way].transmission[Math.round(r.u)]:null;this.portraits[o].show(r),this.portraits[o].svg.classList.toggle("bs-old",!r),this.places[o].textContent=r?`transmission angle ${Number.isFinite(a)?`${N(a,1)}°`:"–"}`:"It does not reach this pose."})}};var zs={rank:{name:"best first",of:i=>i.rank??1/0},worst:{name:"worst miss",of:i=>i.worst??1/0},least:{name:"transmission angle",of:i=>-(i.least??-1)},size:{name:"size",of:i=>i.quality?.extent??1/0},sensitivity:{name:"sensitivity",of:i=>i.quality?.sensitivity??1/0}},Rs={all:{name:"all",holds:()=>!0},usable:{name:"usable",holds:i=>i.usable},pinned:{name:"pinned",holds:(i,t)=>t.has(i.id)}};function Wn(i,{order:t,filter:e,type:s,pinned:n}){let{of:o}=zs[t],{holds:r}=Rs[e];return i.filter(a=>r(a,n)&&(!s||a.type===s)).map((a,l)=>({each:a,k:l,key:o(a)})).sort((a,l)=>Number(n.has(l.each.id))-Number(n.
has(a.each.id))||(a.key===l.key?0:a.key-l.key)||a.k-l.k).map(({each:a})=>a)}var Fe=class{onchange=()=>{};constructor(t={past:[],future:[]}){this.past=t.past.map(e=>({value:e,gesture:null})),this.future=[...t.future]}kept(t){let e=s=>{let n=[];for(let o=s.length-1;o>=0&&(t-=JSON.stringify(s[o]).length)>0;o-=1)n.unshift(s[o]);return n};return{past:e(this.past.map(({value:s})=>s)),future:e(this.future)}}record(t,e){this.future=[];let s=this.past.at(-1);e!==null&&s?.gesture===e||(this.past.push({value:t,gesture:e}),this.past.length>500&&this.past.shift(),this.onchange())}undo(t){let e=this.past.pop();return e?(this.future.push(t),e.value):null}redo(t){let e=this.future.pop();
return e===void 0?null:(this.past.push({value:t,gesture:null}),e)}abandon(t){return this.past.at(-1)?.gesture!==t?null:this.past.pop()?.value}get canUndo(){return this.past.length>0}get canRedo(){return this.future.length>0}};var Yn=150,Sa=1e3,Ea=1,Pa=6,Aa=2,Is=1.2,Kn={linkages:[],dyads:[],best:[],warnings:[],pivot_map:null,family_map:null,outcome:{message:"Two poses or more make a task"}},La=/^data:image\/jpeg;base64,[A-Za-z0-9+/=]+$/,qt="placed",qn=({poses:i,path:t})=>`${i.map(({free:e})=>e?.join("")??"-").join()} ${t?t.closed:""}`,Be=class{solving;placing;solved;constructor({connection:t,document:e,options:s={},name:n="task",settings:o={},filters:r={},choice:a=null,picture:l=null,history:h=void 0,mostFlying:d=Ea}){this.connection=t,this.mostFlying=d,this.renamed=new Map,this.moved=new Map,this.document=e,this.options=
s,this.name=n,this.settings=o,this.filters=r,this.images=new Map,this.picture=this.known(l),this.wanted=a&&{...a,document:e},this.history=new Fe(h),this.history.onchange=()=>this.emit("history"),this.solved=null,this.advice=[],this.solvedFor=null,this.followed=null,this.followedFor=null,this.state="resting",this.progress="",this.chosen=null,this.pinned=new Set,this.placed=null,this.whole=null,this.task=0,this.solvedTask=0,this.selection=null,this.reference=0,this.isOnBody=!1,this.messages=[],this.listeners=new Map,this.basis=null,this.pending=null,this.flying=new Map,this.placing=null,this.solving=
null,t.on("message",p=>this.take(p)),t.on("open",()=>this.opened()),t.on("closed",()=>this.closed())}on(t,e){for(let s of[t].flat().join(" ").split(/\s+/))this.listeners.has(s)||this.listeners.set(s,[]),this.listeners.get(s).push(e)}emit(...t){let e=new Set;for(let s of t)for(let n of this.listeners.get(s)??[])e.has(n)||(e.add(n),n(s))}edit(t,{gesture:e=null,options:s=this.options,picture:n=this.picture}={}){let o=t(this.document);if(o===this.document)return;this.history.record(this.version,e);let r=n!==this.picture;Object.assign(this,{document:o,options:s,picture:n}),this.changed(),r&&this.emit(
"picture")}option(t,e){this.history.record(this.version,null);let{[t]:s,...n}=this.options;this.options=e===void 0?n:{...n,[t]:e},this.changed()}setting(t,e){this.history.record(this.version,null),this.settings=L(this.settings,{[t]:e}),this.emit("document")}rename(t){this.history.record(this.version,null),this.name=t,this.emit("document")}filter(t,e){this.history.record(this.version,t),this.filters={...this.filters,[t]:e},this.emit("filters")}known(t){if(!t||typeof t.data!="string"||!La.test(t.data))return null;let{data:e,...s}=t,{place:n}=s;return[s.width,s.height,s.opacity,n?.turn,n?.scale,n?.
x,n?.y].every(Number.isFinite)?(this.images.set(s.id,e),s):null}get keptPicture(){return this.picture&&{...this.picture,data:this.images.get(this.picture.id)}}setPicture(t,e=null){this.history.record(this.version,e),this.picture=t&&{...this.picture,...t},this.emit("picture")}replace({document:t,options:e={},name:s=this.name,settings:n=this.settings,picture:o=null,choice:r=null}){this.history.record(this.version,null),this.tasks=(this.tasks??0)+1,this.document=t,this.options=e,this.name=s,this.settings=n,this.wanted=r&&{...r,document:t},this.picture=o?.data?this.known(o):o,this.selection=null,this.
reference=0,this.placed=null,this.task=this.tasks,this.changed(),this.emit("selection","placed","reference","picture")}undo(){this.goTo(this.history.undo(this.version))}redo(){this.goTo(this.history.redo(this.version))}abandon(t){this.goTo(this.history.abandon(t))}get version(){let{document:t,options:e,name:s,settings:n,task:o,filters:r,picture:a,choice:l}=this;return{document:t,options:e,name:s,settings:n,task:o,filters:r,picture:a,choice:l}}get choice(){return{chosen:this.chosen,pinned:[...this.pinned]}}goTo(t){if(!t)return;let{choice:e,...s}=t,n=s.document===this.document&&s.options===this.
options;return Object.assign(this,s),this.emit("filters","picture"),this.wanted={...e,document:s.document},n?(this.solvedFor===s.document&&(this.takeWanted(),this.showChosen()),this.emit("document")):this.changed()}changed(){this.placed?.cognateOf&&this.letCognateGo(),this.follow(),this.emit("document"),this.isEmpty&&this.forget(),this.state!=="offline"&&this.setState("dragging"),this.solveAfterRest()}get shown(){return[...new Set([this.chosen,...this.pinned])].filter(t=>t&&t!==qt).slice(0,Pa)}follow(){if(!this.solved||this.flying.size>=this.mostFlying)return;if(!this.canFollow){this.solveMeanwhile();
return}let{document:t,options:e,shown:s}=this,n=this.connection.send({do:"follow",document:t,options:e,shown:s});n!==null&&this.flying.set(n,{document:t,isOld:!1})}get canFollow(){return this.whole!==qn(this.document)}get slow(){return this.canFollow||this.seconds===void 0?null:this.seconds}solveMeanwhile(){if(this.solving||this.state==="offline"||this.isEmpty||this.slow===null||this.slow>Is)return;let{document:t,options:e}=this,s=this.connection.send({do:"solve",document:t,options:e});s!==null&&(this.solving={n:s,document:t,options:e})}solveAfterRest(){clearTimeout(this.resting);let t=performance.
now(),e=()=>{this.flying.size&&performance.now()-t<Sa?this.resting=setTimeout(e,Yn/3):this.solve()};this.resting=setTimeout(e,Yn)}solve(t){clearTimeout(this.resting);let{document:e,options:s}=this;if(!t&&this.solving?.document===e&&this.solving.options===s){this.setState("solving","");return}let n=this.connection.send({do:"solve",document:e,options:s,limit:t});n!==null&&(this.solving={n,document:e,options:s},this.setState("solving",""))}cancel(){this.connection.send({do:"cancel"})}place(t){this.placeWanted=t?.length?t:null,this.placeWanted?this.placing||this.sendPlace():(this.placed=null,this.
emit("placed"))}sendPlace(){let{document:t,options:e,placeWanted:s}=this,n=this.connection.send({do:"place",document:t,options:e,pivots:s});this.placing=n===null?null:{n,pivots:s}}take(t){let{n:e,kind:s}=t;s==="ended"&&this.say(t.messages.map(n=>({tone:s,...n}))),s==="followed"?this.takeFollowed(t):this.flying.has(e)?this.followRefused(t):e===this.placing?.n?this.takePlaced(t):(e===this.solving?.n||s==="cancelled"&&this.solving&&e>this.solving.n)&&this.takeSolving(t)}takeFollowed(t){let e=this.flying.get(t.n);if(!e)return;let{document:s,isOld:n}=e,o=t.from??(n?null:this.basis);this.flying.delete(
t.n),this.pending&&o===this.pending.n&&this.install(this.pending),this.goOn(s);let r=s===this.solvedFor&&!this.followed;o===this.basis&&!r&&(this.followed=t,this.followedFor=s,this.emit("followed")),!this.flying.size&&![this.followedFor,this.solvedFor].includes(this.document)&&this.follow()}goOn(t){[t,...[...this.flying.values()].map(s=>s.document)].includes(this.document)||this.follow()}followRefused({n:t,kind:e,messages:s=[],solve:n=!1,whole:o=!1}){let{document:r}=this.flying.get(t);this.flying.delete(t),e==="refused"&&!n&&this.say(s),o&&(this.whole=qn(r)),this.goOn(r)}takePlaced(t){let{pivots:e}=this.
placing;this.placing=null,this.placeWanted&&t.kind==="placed"?(this.placed={...t,pivots:e},this.emit("placed")):t.kind==="refused"&&this.say(t.messages),this.placeWanted&&this.placeWanted!==e&&this.sendPlace()}takeSolving(t){let{document:e}=this.solving,s=e===this.document,n=this.solvedTask!==this.task;if(t.kind==="progress"||t.kind==="waiting"){let o=`waiting for ${t.before} other${t.before===1?"":"s"}`;s&&this.setState("solving",t.kind==="progress"?t.text:o);return}if(t.kind!=="solving"){if(this.solving=null,t.kind==="solved"){let o={...t,document:e};s||!this.canFollow?this.install(o):this.pending=
o}else n&&this.forget("There is no answer to this task yet");if(t.kind==="refused")this.say(t.messages);else if(!["solved","ended"].includes(t.kind)){let[o]=[t.message].flat();this.say([{tone:t.kind,...typeof o=="string"?{message:o}:o}])}s&&this.setState("resting","")}}get isEmpty(){return this.document.poses.length<Aa}forget(t=Kn.outcome.message){if(!this.solved)return;let e={...this.solved,...Kn,outcome:{message:t},space:{...this.solved.space,quadrics:[]}};this.install({n:null,result:e,document:this.document,seconds:null,was:void 0}),this.placed&&this.place([])}install({n:t,result:e,document:s,
seconds:n,was:o,advice:r=[]}){let a=Object.entries(o??{});if(this.renamed=new Map(a.map(([h,{id:d}])=>[d,h])),this.moved=new Map(a.map(([h,{moved:d}])=>[h,d])),!a.length&&s===this.solvedFor&&!this.followed)for(let{id:h}of e.linkages)this.renamed.set(h,h);let l=h=>h===qt&&this.placed?.linkage?h:this.renamed.get(h)??null;this.isAnother=this.solvedTask!==this.task,this.solved=e,this.advice=r,this.solvedFor=s,this.solvedTask=this.task,this.seconds=n,this.basis=t,this.whole=null,this.pending=null,this.followed=null,this.followedFor=null;for(let h of this.flying.values())h.isOld=!0;this.chosen=l(this.
chosen)??e.linkages[0]?.id??null,this.pinned=new Set([...this.pinned].map(l).filter(Boolean)),this.wanted?.document===s&&this.takeWanted(),this.messages=[],this.emit("solved","chosen","pinned","messages"),s!==this.document&&this.follow()}takeWanted(){let{chosen:t,pinned:e=[]}=this.wanted,s=n=>n===qt?!!this.placed:this.solved.linkages.some(o=>o.id===n);s(t)&&(this.chosen=t),this.pinned=new Set(e.filter(s)),this.wanted=null}takeCognate(t,e){this.placeWanted=null,this.placed={linkage:t,dyads:[],pivots:[],cost:null,messages:[],cognateOf:e},this.chosen=qt,this.emit("placed","chosen")}letCognateGo(){
let{cognateOf:t}=this.placed;this.placed=null,this.chosen===qt&&(this.chosen=t),this.emit("placed","chosen")}opened(){this.flying.clear(),this.solving=this.placing=null,this.setState("resting",""),this.basis=null,this.solve()}closed(){clearTimeout(this.resting),this.flying.clear(),this.solving=this.placing=null,this.setState("offline","")}setState(t,e=""){t===this.state&&e===this.progress||(this.state=t,this.progress=e,this.emit("state"))}say(t){this.messages=t,this.emit("messages")}choose(t){t!==this.chosen&&(this.history.record(this.version,"choose"),this.chosen=t,this.showChosen())}showChosen(){
this.emit("chosen","pinned"),(this.state==="dragging"||this.document!==this.solvedFor)&&this.follow()}pin(t){this.history.record(this.version,null),this.pinned.delete(t)||this.pinned.add(t),this.emit("pinned")}select(t){["kind","index","indices"].every(e=>String(t?.[e])===String(this.selection?.[e]))||(this.selection=t,this.emit("selection"))}get selectedPoses(){let{selection:t,document:e}=this;return t?.kind==="pose"?(t.indices??[t.index]).filter(s=>s<e.poses.length):[]}selectPoses(t,e=t.at(-1)){this.select(t.length?{kind:"pose",index:t.includes(e)?e:t.at(-1),indices:t.length>1?t:void 0}:null)}selectAlso(t){
let e=this.selectedPoses;this.selectPoses(e.includes(t)?e.filter(s=>s!==t):[...e,t],t)}get referenceIndex(){return Math.min(this.reference,this.document.poses.length-1)}setReference(t){this.reference=t,this.emit("reference")}};var Na=40,Xn={order:"rank",filter:"all",type:""},De=class{constructor(t,e,s){this.store=t,this.answers=e,this.cards=new Map,this.wanted={...Xn,...t.filters},this.all=!1;let n=(o,r,a)=>u("label",{},`${o} `,u("select",{"data-choice":a,onchange:l=>this.want(a,l.target.value)},r.map(([l,h])=>u("option",{value:l},h))));this.chips=u("div",{class:"bs-filters",role:"group","aria-label":"Which linkages are shown"}),this.compare=new Ce(t,e,s),this.title=u("h2",{},"Linkages"),this.status=u("p",{class:"bs-results-status",role:"status"}),this.doubt=u("p",{class:"bs-doubt"}),this.gone=u("p",{class:"bs-gone-\
note"}),this.list=u("div",{class:"bs-cards"}),this.more=u("button",{type:"button",class:"bs-small",hidden:!0,onclick:()=>this.showAll()}),this.element=u("section",{class:"bs-results","aria-label":"Linkages"},u("div",{class:"bs-results-head"},this.title,this.status,this.doubt,this.gone,this.chips,u("div",{class:"bs-choices"},n("Sort by",Object.entries(zs).map(([o,{name:r}])=>[o,r]),"order"))),this.compare.element,this.list,this.more),this.pace=new et(()=>this.update()),this.list.addEventListener("keydown",o=>this.walk(o)),e.on("answers placed",()=>this.arrange()),e.on("moved",()=>this.pace.ask()),
e.on("shown",()=>this.update()),t.on("pinned",()=>this.arrange()),t.on("filters",()=>this.filtered()),t.on("state document",()=>this.tell()),this.arrange()}want(t,e){this.store.filter(t,e)}filtered(){Object.assign(this.wanted,Xn,this.store.filters);for(let t of this.element.querySelectorAll("[data-choice]"))O(t,"value",this.wanted[t.dataset.choice??""]);this.arrange()}showAll(){this.all=!0,this.arrange()}arrange(){let{answers:t,store:e,wanted:s}=this;this.buildChips();let n=Wn(t.linkages,{...s,pinned:e.pinned}),o=this.all?n:n.slice(0,Na),r=t.placed?[t.placed,...o]:o,a=new Map;for(let h of r)a.
set(h,this.cards.get(h)??this.card());for(let[h,d]of this.cards)a.has(h)||d.element.remove();this.cards=a;let l=null;for(let h of a.values()){let d=l?l.nextSibling:this.list.firstChild;h.element!==d&&this.list.insertBefore(h.element,d),l=h.element}O(this.more,"hidden",n.length<=o.length),this.more.hidden||_(this.more,`Show all ${n.length}`),this.hidden=t.linkages.length-n.length,this.update()}card(){let{store:t}=this;return new Ie({choose:e=>t.choose(e),pin:e=>t.pin(e),improve:e=>this.improve(e),letGo:()=>this.letGo()})}letGo(){this.store.placed?.cognateOf?this.store.letCognateGo():this.store.
place([]),this.store.chosen===tt&&this.store.choose(this.answers.linkages[0]?.id??null)}buildChips(){let{answers:{linkages:t},store:{pinned:e},wanted:s}=this,n=[...new Set(t.map(l=>l.type))].sort();n.includes(s.type)||(s.type="");let o=(l,h,d,p)=>({key:l,value:h,text:`${d} ${p}`,on:s[l]===h}),r=[...Object.entries(Rs).map(([l,{name:h,holds:d}])=>o("filter",l,h,t.filter(p=>d(p,e)).length)),...n.length>1?n.map(l=>o("type",l,l,t.filter(h=>h.type===l).length)):[]],a=JSON.stringify(r);a!==this.chipsSaid&&(this.chipsSaid=a,this.chips.replaceChildren(...r.map(({key:l,value:h,text:d,on:p})=>u("button",
{type:"button",class:"bs-filter","data-chip":h,"aria-pressed":String(p),onclick:()=>this.want(l,l==="type"&&p?"":h)},d))))}update(){let{answers:t,store:e}=this,{data:s,isOld:n,shown:o}=t;for(let[r,a]of this.cards)a.show(r,{data:s,old:n&&r.id!==tt,best:t.linkages[0],chosen:r===o,pinned:e.pinned.has(r.id)});this.tell()}tell(){let{answers:t,store:e}=this,s=t.linkages.filter(r=>!r.gone),n=s.filter(r=>r.usable).length;_(this.title,s.length?`${s.length} linkage${s.length===1?"":"s"}, ${n} usable`:e.solved?"No linkage":"Linkages"),f(this.status,"aria-live",e.state==="dragging"?"off":"polite"),_(this.
status,this.statusText());let o=e.followed?.uncertain??[];_(this.doubt,e.followed&&t.isOld?o.length?`May change when you let go: ${o[0]}${/[.!]$/.test(o[0])?"":"."}`:e.followed.complete===!1?"A linkage that appears now is seen when you let go.":"":""),_(this.gone,!t.isOld&&t.gone.length?`Not in the new answer: ${Ye(t.gone)} of the one before.`:""),this.element.classList.toggle("bs-stale",t.isOld)}statusText(){let{store:t,answers:e}=this,s=this.hidden?`${this.hidden} not shown by the filter. `:"";if(t.state==="offline")return"The connection is gone; what you see is the last answer.";if(e.isOld&&
t.state==="dragging")return t.followed?"Moving along.":this.whenSolved();if(t.state==="solving")return"Looking for all linkages.";if(!t.solved)return"";let{best:n,outcome:o}=t.solved;return t.solved.linkages.some(r=>r.usable)?`${s}${n?.[0]??""}`:`${s}${za(o?.message)}${o?.help?` What helps: ${o.help}.`:""}`}whenSolved(){let{slow:t}=this.store;if(t===null)return"The new answer comes when you let go.";let e=`All linkages are looked for anew, which took ${t<.95?"less than a second":`${Math.round(t)} s`} last time`;return t>Is?`${e}: the new answer comes when you let go.`:`${e}: the answer lags be\
hind your hand by so much.`}async improve(t){let{document:e,options:s,connection:n}=this.store,o=()=>[...this.cards].find(([a])=>a.id===t)?.[1];o()?.tellBetter(["Looking near it …"]);let r;try{r=(await(await n.post("/improve",{document:e,options:s,linkage:t})).json()).better}catch(a){r=[`That did not work: ${a.message}`]}e===this.store.document&&o()?.tellBetter(r.length?r.map(Ta):["Nothing better lies near it."])}walk(t){let e={ArrowDown:1,ArrowRight:1,ArrowUp:-1,ArrowLeft:-1}[t.key],s=[...this.cards.values()].map(o=>o.main),n=s.indexOf(this.list.getRootNode().activeElement);!e||n<0||(t.preventDefault(),
s[E(n+e,0,s.length-1)].focus())}},Ta=i=>i.replace(/^L\d+ changes/,"One changes"),za=i=>i?`${i[0].toUpperCase()}${i.slice(1)}.`:"";var Ra=["x","y","angle","drive","transmission"],Hn=["x","y","angle_deg","position","turned_deg","transmission_deg"];function Gn(i){let t=new DataView(i).getUint32(0,!0),e=JSON.parse(new TextDecoder().decode(new Uint8Array(i,4,t))),s=Ia(i,4+t);for(let n of e.linkages??[]){if(n.ways&&(n.ways=n.ways.map(a=>({...a,...Un(s,a,Ra)}))),!n.poses)continue;let{count:o}=n.poses,r=Un(s,n.poses,Hn);n.pose_errors=Array.from({length:o},(a,l)=>{let h=n.at?.[l]??null,d={way:h?h[0]:null,frame:h?h[1]:null};for(let p of Hn){let c=r[p][l];d[p]=Number.isNaN(c)?null:c}return d})}return e}function Ia(i,t){if(new Uint8Array(
new Uint16Array([1]).buffer)[0]===1)return new Float32Array(i,t);let e=new DataView(i,t);return Float32Array.from({length:e.byteLength/4},(s,n)=>e.getFloat32(4*n,!0))}function Un(i,{start:t,count:e},s){return Object.fromEntries(s.map((n,o)=>[n,i.subarray(t+o*e,t+(o+1)*e)]))}var ja=1500,We=class{constructor(t){this.model=t,this.view=Math.random().toString(36).slice(2),this.listeners={message:[],open:[],closed:[],told:[],busy:[]},this.n=0,this.waiting=null,this.heard=(e,s)=>this.take(e,s),t.on("msg:custom",this.heard)}on(t,e){this.listeners[t].push(e)}emit(t,e){for(let s of this.listeners[t])s(e)}take(t,e=[]){t.view!==null&&t.view!==this.view||(this.rest(),t.n===void 0?this.emit("told",t):this.emit("message",t.kind==="followed"?Gn(Ca(e[0])):t))}send(t){return this.n+=1,t.do!=="choose"&&(this.waiting??=setTimeout(()=>this.emit("busy",!0),ja)),this.model.send({view:this.
view,n:this.n,...t}),this.n}rest(){clearTimeout(this.waiting),this.waiting=null,this.emit("busy",!1)}close(){clearTimeout(this.waiting),this.model.off("msg:custom",this.heard)}};function Ca(i){return i instanceof ArrayBuffer?i:i.buffer.slice(i.byteOffset,i.byteOffset+i.byteLength)}var Zn=`/* The widget of a notebook; in a shadow root, after widget.css and studio.css. */

:host { display: block; }
.bm.bn { min-height: 0; font-size: 14px; border: 1px solid var(--bm-line); border-radius: 8px; overflow: hidden; background: var(--bm-panel); }
.bn-main { display: grid; height: 470px; grid-template-columns: minmax(0, 1fr) 236px; }
.bn-left { display: grid; gap: 5px; padding: 7px 10px 8px; min-width: 0; min-height: 0; grid-template: auto minmax(0, 1fr) auto / minmax(0, 1fr); }
.bn-bar { display: flex; gap: 5px; align-items: center; min-width: 0; }
.bs .bn-bar .bm-button { min-height: 28px; min-width: 30px; padding: 1px 8px; font-size: 0.82rem; }
.bm .bn-line { flex: 1; min-width: 0; min-height: 2.6em; max-height: 2.6em; overflow: auto; display: flex; align-items: center; margin-left: 5px; font-size: 0.78rem; line-height: 1.3; color: var(--bm-muted); }
.bm .bn-line.bn-refused { color: var(--bm-bad); }
.bn-still { padding: 0 10px 8px; overflow: auto; }
.bn-still svg { background: #fff; max-width: 100%; height: auto; }
.bn-still figure { margin: 0; }
.bm .bn-still table { width: auto; }
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
.bn .bs-results { padding: 8px 8px 8px 10px; min-height: 0; align-content: start; grid-template-rows: auto minmax(0, 1fr); gap: 6px; border-left: 1px solid var(--bm-line); background: var(--bm-bg); }
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
`;var js="(prefers-color-scheme: dark)";function Vn(i,t,e){let s=t.map(h=>{let d=new CSSStyleSheet;return d.replaceSync(h.replace(/([\d.]+)rem\b/g,(p,c)=>`${16*c}px`)),d}),n=s.flatMap(({cssRules:h})=>[...h]).filter(h=>h.media?.mediaText===js),o=()=>{let h=Ba(i.host);for(let d of n)d.media.mediaText=h?"all":"not all";i.host.style.colorScheme=h?"dark":"light"},r=()=>{o(),setTimeout(o,400)},a=new MutationObserver(r);for(let h of[document.documentElement,document.body])a.observe(h,{attributes:!0});matchMedia(js).addEventListener("change",r,{signal:e});let l=new ResizeObserver(o);l.observe(i.host),e.addEventListener("abort",()=>[a,l].forEach(
h=>h.disconnect())),i.adoptedStyleSheets=s,r()}function Ba(i){for(let t=i;t;t=t.parentElement??t.getRootNode().host){let e=getComputedStyle(t).backgroundColor,[s,n,o,r=1]=e.startsWith("rgb")?(e.match(/[\d.]+/g)??[]).map(Number):[0,0,0,0];if(r>.5)return .299*s+.587*n+.114*o<128}return matchMedia(js).matches}var Da=2,Wa=700,Ya="The kernel is busy: what is done here is answered when it is free.",Ka="No kernel answers: this is the linkage as it was last. Run the cell to take hold of it.",qa="Drag a pose by its point, turn it by the tip of its arrow.",Xa="Drag poses by their points, turn them by the tips of their arrows; limits, regions and the body are dragged, too.";function Ha({model:i,el:t}){let e=u("p",{class:"bn-line"},"Waiting for the kernel…"),s=u("div",{class:"bn-still"});s.append(...new DOMParser().parseFromString(i.get("still")??"","text/html").body.childNodes);let n=new AbortController,
{signal:o}=n,r=new We(i),a=u("div",{}),l=u("div",{class:"bm bs bn"},e,s);a.attachShadow({mode:"open"}).append(l),t.replaceChildren(a),Vn(a.shadowRoot,[qs,Ks,Zn],o),Ja(a);let h=null;r.on("message",p=>{p.kind==="opened"&&!h&&(h=Ua(l,r,p,d))}),r.on("told",p=>{p.kind==="task"&&p.by!==r.view?h?.replace(p.document):p.kind==="chosen"&&p.id&&h?.store.choose(p.id)});let d=()=>{i.set("turn",i.get("turn")+1),i.save_changes()};return r.on("busy",p=>p&&_(e,Ka)),r.send({do:"open"}),()=>{n.abort(),r.close(),h?.playing.player.play(!1),t.replaceChildren()}}function Ua(i,t,{document:e},s){let n=new Be({connection:t,
document:e,mostFlying:Da}),o=new xe(n,{zoomKey:!0}),r=new se(n),a=new Pe(n,r);new Oe(r,a,o),new ye(n,o),new Te(n,o),new Le(n,o);let l=new De(n,r,a),h=u("div",{class:"bn-left"},Ga(n,o,t),o.element,a.element),d=a.element.querySelector(".bs-player-ways"),p=u("details",{class:"bn-ways"},u("summary",{},"Driver and assembly"));d.replaceWith(p),p.append(d),i.replaceChildren(u("div",{class:"bn-main"},h,l.element)),o.resize();let c=Va(n,o);return ln(n,o,null,i),hn(a,i),_n(n,r,a),n.on("chosen",()=>{t.send({do:"choose",id:n.chosen,basis:n.basis}),s()}),t.emit("open"),{store:n,playing:a,replace:g=>{if(JSON.
stringify(g)!==JSON.stringify(n.document))n.replace({document:g}),c();else if(n.solvedFor===n.document)return;n.solve()}}}function Ga(i,t,e){let s=bt("↶",()=>i.undo(),{"data-do":"undo",title:"Undo (Ctrl+Z)","aria-label":"Undo"}),n=bt("↷",()=>i.redo(),{"data-do":"redo",title:"Redo (Ctrl+Shift+Z)","aria-label":"Redo"}),o=bt("Stop",()=>i.cancel(),{"data-do":"cancel",title:"Stop solving",hidden:!0}),r=bt("Add poses",()=>t.use(t.tool?null:new Ne(i,t)),{"data-do":"add-poses","aria-pressed":"false"}),a=u("p",{class:"bn-line",role:"status"}),l=!1,h=()=>{O(s,"disabled",!i.history.canUndo),O(n,"disa\
bled",!i.history.canRedo);let[p]=i.messages,c=i.state==="solving"&&i.progress;f(r,"aria-pressed",!!t.tool);let m=l?Ya:p?[p.message,p.help].filter(Boolean).join("; "):t.tool?t.tool.hint:c?`Solving: ${i.progress}`:Za(i.document);a.textContent!==m&&(a.textContent=m),a.classList.toggle("bn-refused",!!p)};e.on("busy",p=>{p!==l&&(l=p,h())});let d;return i.on("state",()=>{clearTimeout(d),i.state==="solving"?d=setTimeout(()=>O(o,"hidden",!1),Wa):O(o,"hidden",!0)}),i.on("document state messages solved",h),t.on("tool",h),h(),u("div",{class:"bn-bar"},s,n,r,bt("Fit",()=>t.fitAgain(),{"data-do":"fit",title:"\
Show all poses and pivots (0)"}),o,a)}function Za(i){return X(i).length||j(i).length||Z(i).length?Xa:qa}function Va(i,t){let e=!0;return i.on("solved",()=>{e&&t.isFitted&&t.fit(),e=!1}),()=>e=!0}function Ja(i){i.addEventListener("keydown",t=>{(!(t.ctrlKey||t.metaKey)||/^[zy]$/i.test(t.key))&&t.stopPropagation()})}var am={render:Ha};export{am as default};
