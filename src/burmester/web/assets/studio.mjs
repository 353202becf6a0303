// Made by scripts/bundle from src/burmester/web/studio: change those files, not this one.
var SVG="http://www.w3.org/2000/svg";function furnish(node,attributes,children){for(const[name,value]of Object.entries(attributes??{})){if(value===null||value===
void 0||value===false)continue;if(name.startsWith("on"))node.addEventListener(name.slice(2),value);else node.setAttribute(name,value===true?"":value)}node.append(
...children.flat(Infinity).filter(child=>child!==null&&child!==void 0));return node}var h=(tag,attributes,...children)=>furnish(document.createElement(tag),attributes,
children);var s=(tag,attributes,...children)=>furnish(document.createElementNS(SVG,tag),attributes,children);function put(node,name,value){const text=String(value);
if(node.getAttribute(name)!==text)node.setAttribute(name,text)}function give(node,name,value){const next=typeof node[name]==="boolean"?Boolean(value):String(value);
if(node[name]!==next)node[name]=next}function say(node,text){const next=String(text);if(node.textContent!==next)node.textContent=next}function rgb(text){const hex=text.
trim().replace("#","");return[0,2,4].map(k=>parseInt(hex.slice(k,k+2),16))}var clamp=(value,low,high)=>Math.min(Math.max(value,low),high);var degrees=angle=>angle*180/Math.PI;var radians=angle=>angle*Math.PI/180;var px=value=>Math.abs(
value)<1e7?+value.toFixed(5):Math.sign(value)*1e7;function fixed(value,digits){if(value===null||value===void 0||!Number.isFinite(value))return"–";const text=value.
toFixed(digits);return Number(text)===0?text.replace("-",""):text}function figure(value){if(value===null||!Number.isFinite(value))return"–";if(value===0)return"\
0";if(Math.abs(value)>=99.5&&Math.abs(value)<1e6)return value.toFixed(0);const rounded=value.toExponential(1),[digits,power]=rounded.split("e").map(Number);if(power>=
-4&&power<2)return String(Number(rounded));if(power>0)return`${digits}e${power}`;return`${digits}e-${String(-power).padStart(2,"0")}`}var spans=extent=>`${figure(
extent)} span${figure(extent)==="1"?"":"s"}`;function ticks(low,high,about){const rough=(high-low)/Math.max(1,about);const power=10**Math.floor(Math.log10(rough));
const step=[1,2,5,10].map(k=>k*power).find(each=>each>=rough*.999)??10*power;const digits=Math.max(0,-Math.floor(Math.log10(step*1.0001)));const marks=[];for(let k=Math.
ceil(low/step-1e-9);k*step<=high+step*1e-9;k+=1){marks.push({at:k*step,text:fixed(k*step,digits)})}return marks}function angleTicks(low,high,about){const step=[
5,10,15,30,45,60,90,180].find(each=>(high-low)/each<=about)??360;const marks=[];for(let k=Math.ceil(low/step-1e-9);k*step<=high+1e-6;k+=1){marks.push({at:k*step,
text:`${fixed(k*step,0)}°`})}return marks.length>1?marks:ticks(low,high,about).map(t=>({...t,text:`${t.text}°`}))}function listed(words){if(words.length<2)return words.
join("");return`${words.slice(0,-1).join(", ")} and ${words[words.length-1]}`}function runs(numbers,names){const parts=[];for(let k=0;k<numbers.length;){let end=k;
while(end+1<numbers.length&&numbers[end+1]===numbers[end]+1)end+=1;if(end-k>=2)parts.push(`${names[numbers[k]-1]}–${names[numbers[end]-1]}`);else for(let i=k;i<=
end;i+=1)parts.push(names[numbers[i]-1]);k=end+1}return listed(parts)}var LENGTHS={µm:1e-6,um:1e-6,mm:.001,cm:.01,m:1,in:.0254,inch:.0254,'"':.0254,"″":.0254,ft:.3048,"'":.3048,"′":.3048};var ANGLES={"°":1,deg:1,degree:1,degrees:1,
rad:180/Math.PI,mrad:.18/Math.PI};var WRITTEN=/^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[+-]?\d+)?)\s*(.*)$/i;var DIGITS=12;var GREATEST=1e300;var tidy=value=>Number(
value.toPrecision(DIGITS));var written=value=>value===void 0||value===null?"":String(value).replace("-","−").replace("e−","e-");function quantity(text,{kind="\
number",unit:unit2="",optional=false,least:least2=-Infinity,above=-Infinity,below=Infinity,whole=false}={}){const plain=text.normalize("NFKC").replace(/[−–]/g,
"-").replace(/[\u00a0\u2009\u202f]/g," ").trim();const example={length:unit2 in LENGTHS?`12.5 or 0.5 in`:"12.5",angle:"30 or 0.5 rad",number:"12.5"}[kind];if(!plain)
return optional?{value:void 0}:{fault:`A number is missing here: write one such as ${example}.`};const found=WRITTEN.exec(plain);if(!found)return{fault:`“${text.
trim()}” is not a number: write one such as ${example}.`};const number=Number(found[1].replace(",",".")),name=found[2].trim().replace(/^μm$/,"µm");const factor=factorOf(
name,kind,unit2);if(typeof factor==="string")return{fault:factor};const value=factor===1?number:tidy(number*factor);if(!(Math.abs(value)<=GREATEST))return{fault:`${text.
trim()} is too large a number.`};const shown2=kind==="angle"?"°":kind==="length"&&unit2?` ${unit2}`:"";if(whole&&!Number.isInteger(value))return{fault:`This ha\
s to be a whole number, such as ${Math.max(1,Math.round(value))}.`};if(value<least2)return{fault:`This may not be less than ${least2}${shown2}.`};if(value<=above)
return{fault:`This must be greater than ${above}${shown2}.`};if(value>=below)return{fault:`This must be less than ${below}${shown2}.`};return{value}}function factorOf(name,kind,unit2){
if(!name||kind==="length"&&name===unit2)return 1;if(kind==="number")return`“${name}” is not needed here: write the number alone.`;const units=kind==="angle"?
ANGLES:LENGTHS,known=name in units?name:name.toLowerCase();if(!Object.hasOwn(units,known)){const usual=kind==="angle"?"° or rad":"mm, cm, m, in or ft";return`“${name}\
” is not a unit of ${kind} known here: write ${usual}, or the number alone.`}if(kind==="angle")return units[known];if(!Object.hasOwn(LENGTHS,unit2))return`Thi\
s task has ${unit2?`the unit ${unit2}`:"no unit of length"}: write the number alone.`;return units[known]/LENGTHS[unit2]}var made=0;var NumberField=class{constructor({label,options,commit,step=()=>1,attributes={}}){made+=1;this.options=options;this.commit=commit;this.value=void 0;
this.drafts=new Map;this.fault=h("p",{class:"bs-fault",id:`bs-fault-${made}`,hidden:true});this.input=h("input",{class:"bs-number",type:"text",inputmode:"text",
autocomplete:"off",spellcheck:"false","aria-label":label,...attributes,onchange:()=>this.read(),oninput:()=>this.fault.hidden||this.read(),onkeydown:event=>this.
nudge(event,step())});this.element=h("span",{class:"bs-field"},this.input,this.fault)}show(value){const changed=value!==this.value;this.value=value;if(changed||
this.fault.hidden){const text=written(value);if(this.input.value!==text&&!(this.isEdited&&!changed))this.input.value=text;if(changed)this.say(null)}}turnTo(id,value){
if(id===this.id)return;if(this.fault.hidden)this.drafts.delete(this.id);else this.drafts.set(this.id,this.input.value);const draft=this.drafts.get(id);this.id=id;
this.value=value;give(this.input,"value",draft??written(value));this.say(draft===void 0?null:quantity(draft,this.options()).fault??null)}get isEdited(){return document.
activeElement===this.input&&this.input.value!==written(this.value)}read(){const{value,fault}=quantity(this.input.value,this.options());this.say(fault??null);if(fault)
return;const isNew=value!==this.value;this.value=value;if(document.activeElement!==this.input||!isNew)this.input.value=written(value);if(isNew)this.commit(value);
this.input.value=written(this.value)}nudge(event,step){if(event.key==="Enter")this.read();const sense={ArrowUp:1,ArrowDown:-1}[event.key];if(!sense||event.ctrlKey||
event.metaKey)return;const{value,fault}=quantity(this.input.value,this.options());if(fault||value===void 0)return;event.preventDefault();this.input.value=written(
stepped(value,sense*stepOf(event,step)));this.read()}say(sentence2){give(this.fault,"hidden",sentence2===null);say(this.fault,sentence2??"");if(sentence2===null){
this.input.removeAttribute("aria-invalid");this.input.removeAttribute("aria-describedby")}else{put(this.input,"aria-invalid","true");put(this.input,"aria-descri\
bedby",this.fault.id)}}};var stepOf=(event,step)=>step*(event.shiftKey?10:event.altKey?.1:1);var stepped=(value,by)=>Number((value+by).toPrecision(12));var labelled=(text,control,hint)=>h(
"label",{class:"bs-labelled"},h("span",{class:"bs-label"},text),control,hint?h("span",{class:"bs-hint"},hint):null);function textField(label,commit,attributes={}){
return h("input",{class:"bs-text",type:"text",autocomplete:"off",spellcheck:"false","aria-label":label,...attributes,onchange:event=>commit(event.target.value)})}
function tick(text,commit,attributes={}){const box=h("input",{type:"checkbox",...attributes,onchange:event=>commit(event.target.checked)});return{box,element:h(
"label",{class:"bs-tick"},box," ",text)}}function choice(label,pairs,commit,attributes={}){return h("select",{class:"bs-choice","aria-label":label,...attributes,
onchange:event=>commit(event.target.value)},pairs.map(([value,text])=>h("option",{value},text)))}var button=(text,onclick,attributes={})=>h("button",{type:"butt\
on",class:"bm-button",onclick,...attributes},text);var KEY="burmester.studio.arrangement";var LEAST=120;var LEFT=160;var STEP=24;var kept=(()=>{try{return Object(JSON.parse(localStorage.getItem(KEY)??"{}"))}catch{
return{}}})();function remember(name,value){kept[name]=value;try{localStorage.setItem(KEY,JSON.stringify(kept))}catch{}}var resized=()=>dispatchEvent(new Event(
"resize"));function walkByArrows(group,which){const all=()=>[...group.querySelectorAll(which)].filter(each=>each.checkVisibility());const stop=one=>{for(const each of group.
querySelectorAll(which))put(each,"tabindex",each===one?0:-1)};group.addEventListener("focusin",({target})=>target instanceof Element&&target.matches(which)&&stop(
target));group.addEventListener("keydown",event=>{const there2=all(),at=there2.indexOf(event.target),last=there2.length-1;const to={ArrowRight:at+1,ArrowDown:at+
1,ArrowLeft:at-1,ArrowUp:at-1,Home:0,End:last}[event.key];if(at<0||to===void 0||event.ctrlKey||event.metaKey||event.altKey)return;event.preventDefault();there2[(to+
there2.length)%there2.length].focus()});return{stop,first:()=>stop(group.querySelector(`${which}[aria-selected=true]`)??all()[0]??group.querySelector(which))}}function sidePanel(name,title,element,attributes={}){
const fold=button("",()=>show(!panel.classList.contains("bs-folded"),true),{class:"bs-fold","data-fold":name});const panel=h("section",{class:`bs-side bs-side-${name}`,
"aria-label":title,...attributes},fold,element);const show=(folded,said=false)=>{panel.classList.toggle("bs-folded",folded);put(fold,"aria-expanded",!folded);put(
fold,"aria-label",`${folded?"Show":"Hide"}: ${title}`);give(fold,"title",fold.getAttribute("aria-label"));fold.replaceChildren(h("span",{"aria-hidden":"true"},name===
"left"===folded?"»":"«"),h("span",{class:"bs-fold-name","aria-hidden":"true"},title));if(!said)return;remember(`${name} folded`,folded);resized()};show(kept[`${name}\
 folded`]===true);return panel}var Drawer=class{constructor(){this.tabs=new Map;this.list=h("div",{class:"bs-tabs",role:"tablist","aria-label":"Charts, maps and\
 tables"});this.grip=h("div",{class:"bs-grip",role:"separator",tabindex:0,"aria-orientation":"horizontal","aria-label":"Height of the drawer",title:"Drag to cha\
nge the height"});this.panels=h("div",{class:"bs-drawer-panels",id:"bs-panels"});this.element=h("section",{class:"bs-drawer","aria-label":"Charts, maps and tabl\
es"},this.grip,this.list,this.panels);this.walk=walkByArrows(this.list,"[role=tab]");this.listen();this.setHeight(kept.height);this.open(null);addEventListener(
"beforeprint",()=>this.showAll(true));addEventListener("afterprint",()=>this.showAll(false))}add(name,title,element,isWanted=()=>true){const tab=h("button",{type:"\
button",role:"tab",class:"bs-tab",id:`bs-tab-${name}`,"data-tab":name,"aria-controls":`bs-panel-${name}`,onclick:()=>this.open(this.shown===name?null:name,true)},
title);const panel=h("section",{class:`bs-panel bs-panel-${name}`,id:`bs-panel-${name}`,role:"tabpanel",tabindex:0,"data-panel":name,"aria-labelledby":tab.id},h(
"h2",{},title),element);this.tabs.set(name,{tab,panel,isWanted});this.list.append(tab);this.panels.append(panel);this.open(this.shown??(kept.tab===name?name:null))}update(){
for(const{tab,panel,isWanted}of this.tabs.values()){give(tab,"hidden",!isWanted());panel.classList.toggle("bs-unwanted",tab.hidden)}if(this.tabs.get(this.shown)?.
tab.hidden)this.open(null);this.walk.first()}open(name,said=false){this.shown=name;for(const[each,{tab,panel}]of this.tabs){put(tab,"aria-selected",each===name);
give(panel,"hidden",each!==name)}this.element.classList.toggle("bs-closed",name===null);give(this.grip,"hidden",name===null);this.walk.first();if(said)remember(
"tab",name);resized()}showAll(on){this.element.classList.toggle("bs-on-paper",on);for(const[each,{panel,tab}]of this.tabs)give(panel,"hidden",on?tab.hidden:each!==
this.shown)}setHeight(height){const most=Math.max(LEAST,innerHeight-LEFT);this.height=clamp(Number.isFinite(height)?height:.34*innerHeight,LEAST,most);this.element.
style.setProperty("--bs-height",`${Math.round(this.height)}px`);for(const[name,value]of[["min",LEAST],["max",most],["now",this.height]])put(this.grip,`aria-valu\
e${name}`,Math.round(value))}listen(){const{grip}=this;const take=height=>{this.setHeight(height);remember("height",this.height);resized()};let from=null;grip.addEventListener(
"pointerdown",event=>{event.preventDefault();grip.setPointerCapture(event.pointerId);from={y:event.clientY,height:this.height}});grip.addEventListener("pointerm\
ove",event=>from&&take(from.height+from.y-event.clientY));for(const name of["pointerup","pointercancel"])grip.addEventListener(name,()=>from=null);grip.addEventListener(
"keydown",event=>{const by={ArrowUp:STEP,ArrowDown:-STEP}[event.key];if(!by)return;event.preventDefault();take(this.height+by)})}};function sheets(root,all){const buttons=all.
map(([name,title])=>button(title,()=>show(name,true),{class:"bs-sheet","data-sheet-of":name}));const show=(name,said=false)=>{all.forEach(([each,,element],k)=>{
element.classList.toggle("bs-below",each!==name);put(buttons[k],"aria-pressed",each===name)});if(!said)return;remember("sheet",name);resized()};show(all.some(([
name])=>name===kept.sheet)?kept.sheet:all[1][0]);return h("div",{class:"bs-sheets",role:"group","aria-label":"Beside the plane"},buttons)}var KEY2="burmester.studio";var TAB="burmester.studio.tab";var SOON=400;var Autosave=class{constructor(store){this.store=store;store.on("document",()=>this.soon());
store.connection.on("open",()=>this.isOpen&&this.soon());addEventListener("pagehide",()=>this.keep());document.addEventListener("visibilitychange",()=>document.
visibilityState==="hidden"&&this.keep())}soon(){clearTimeout(this.timer);this.isOpen=true;put(document.documentElement,"data-kept",false);this.timer=setTimeout(
()=>this.keep(),SOON)}keep(){if(!this.isOpen)return;this.isOpen=false;clearTimeout(this.timer);const{document:task,options,name,settings,connection}=this.store,
text={document:task,options,name,settings};document.documentElement.dataset.kept="true";try{sessionStorage.setItem(KEY2,JSON.stringify(text))}catch{}connection.
post("/autosave",{...text,tab:tabName()},"PUT").catch(()=>this.isOpen=true)}};function tabName(){try{const name=sessionStorage.getItem(TAB)??crypto.randomUUID();
sessionStorage.setItem(TAB,name);return name}catch{return"tab"}}function keptHere(){try{const kept2=JSON.parse(sessionStorage.getItem(KEY2)??"null");return Array.
isArray(kept2?.document?.poses)?kept2:null}catch{return null}}var ROLES={refused:"alert",offline:"alert",limit:"alert",ended:"alert",expired:"alert"};var LONGEST_HELP=240;var NO_FILE="task.json";function sentenceOf({code,message,
where,why,help}){return h("li",{},code?h("span",{class:"bm-code"},code):null," ",h("span",{},message),where&&!where.startsWith(NO_FILE)?h("pre",{class:"bs-where"},
where):null,why?h("p",{class:"bs-why"},`Why: ${why}.`):null,help?helpOf(help):null)}function helpOf(help){if(help.length<=LONGEST_HELP)return h("p",{class:"bs-h\
elp"},`What to do: ${help}.`);const end=help.slice(0,LONGEST_HELP).lastIndexOf("; "),cut=end>0?end:help.slice(0,LONGEST_HELP).lastIndexOf(" ");return h("div",{class:"\
bs-help"},h("p",{},`What to do: ${help.slice(0,cut)}${end>0?".":" …"}`),h("details",{},h("summary",{},"More"),h("p",{},`${help.slice(cut).replace(/^[; ]+/,"")}\
.`)))}var Banners=class{files;constructor(store){this.store=store;this.shown=new Map;this.element=h("div",{class:"bs-banners"});this.status=h("p",{class:"bs-sta\
tus"});this.live=h("p",{class:"bs-unseen",role:"status"});new ResizeObserver(()=>document.body.style.setProperty("--bs-banners",`${this.element.offsetHeight}px`)).
observe(this.element);store.on("messages",()=>this.messages());store.on("state solved messages",()=>this.state())}say(kind,title,messages=[],{undo=false,actions=[]}={}){
const close=button("✕",()=>this.close(kind),{"aria-label":"Close",class:"bs-close"});const all=[...actions,...undo?[button("Undo",()=>(this.close(kind),this.store.
undo()))]:[]];const banner=h("section",{class:`bs-banner bs-${kind}`,role:ROLES[kind]??"status","data-banner":kind},h("p",{class:"bs-banner-title"},title),messages.
length?h("ul",{},messages.map(sentenceOf)):null,all.length?h("div",{class:"bs-row"},all):null,kind==="offline"?null:close);this.shown.get(kind)?.remove();this.shown.
set(kind,banner);this.element.append(banner)}close(kind){this.shown.get(kind)?.remove();this.shown.delete(kind)}messages(){const{store}=this,{messages}=store,[first]=messages;
this.close("limit");this.close("refused");if(!first||store.document.poses.length<2)return;const shown2=store.solved?.linkages.length?" What is shown was followe\
d from the answer before.":"";if(first.tone==="cancelled")this.say("note",`Solving was stopped.${shown2}`,[],{actions:[this.again()]});else if(first.tone==="lim\
it")this.say("limit",`Solving took too long and was stopped. Nothing of the task is lost.${shown2}`,messages,{actions:[this.again()]});else if(first.tone==="end\
ed")this.say("ended","The process that computes for this page has ended. Nothing of the task is lost.",messages,{actions:[this.again()]});else this.say("refused",
"The task cannot be solved as it is.",messages)}again(){return button("Solve again",()=>{this.close("note");this.close("limit");this.close("ended");this.store.solve()},
{"data-do":"solve-again"})}state(){const{store}=this,solving=store.state==="solving";if(store.state==="offline")this.offline();else this.close("offline");put(this.
status,"data-state",store.state);if(store.state==="dragging")return;const said=store.state==="offline"?"Not connected":this.summary();say(this.status,solving?`S\
olving${store.progress?`: ${store.progress}`:"…"}`:said);if(!solving&&said)say(this.live,said)}summary(){const{solved,solvedFor,document:document2,messages}=this.
store;if(document2.poses.length<2)return"Two poses or more make a task";if(messages.length)return"Not solved";if(!solved||solvedFor!==document2)return"";const count=solved.
linkages.length,usable=solved.linkages.filter(each=>each.usable).length;return count?`${count} linkage${count===1?"":"s"}, ${usable} usable`:"No linkage"}offline(){
if(this.shown.has("offline"))return;this.say("offline","The server does not answer. Nothing is lost: the task is in this page, and can still be changed and save\
d.",[],{actions:[button("Save the task (JSON)",()=>this.files.saveWithoutServer(),{"data-do":"save-json"}),h("span",{class:"bs-hint"},"The page tries again by i\
tself. If the server has ended, start burmester studio with that file, or drop the file on the new page.")]})}expired(){this.close("offline");this.say("expired",
"The server was started anew. Nothing is lost: open the address that it printed in this tab, and go on here.",[],{actions:[button("Save the task (JSON)",()=>this.
files.saveWithoutServer())]})}};var AXIS=26;var BLOCK=[22,14];var transform=(x,y,angle)=>`translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;function foot(){let hatch="";for(let k=-2;k<=
2;k+=1)hatch+=`M${5.5*k+3} 16l-6 7`;return s("g",{class:"bm-foot"},s("path",{class:"bm-solid",d:"M0 0L-10 16H10Z"}),s("path",{class:"bm-ground",d:`M-16 16H16${hatch}`}))}
function axes(length){const l=length,head2=Math.max(4,.22*length);return`M0 0H${l}m${-head2} ${-head2/2}l${head2} ${head2/2}l${-head2} ${head2/2}M0 0V${-.6*l}`}
function polyline(points,view){let path2="",pen="M";for(const[x,y]of points){if(!Number.isFinite(x)||!Number.isFinite(y)){pen="M";continue}path2+=`${pen}${px(view.
X(x))} ${px(view.Y(y))}`;pen="L"}return path2}function hull(points){const sorted=[...points].sort((p,q)=>p[0]-q[0]||p[1]-q[1]);const half=list=>{const kept2=[];
for(const point2 of list){while(kept2.length>1){const[a,b]=kept2.slice(-2);if((b[0]-a[0])*(point2[1]-a[1])-(b[1]-a[1])*(point2[0]-a[0])>0)break;kept2.pop()}kept2.
push(point2)}return kept2.slice(0,-1)};const corners=[...half(sorted),...half(sorted.reverse())];return corners.length?corners:sorted.slice(0,1)}function act(place,[x,y]){const c=Math.cos(place.a),d=Math.sin(place.a);return[place.x+c*x-d*y,place.y+d*x+c*y]}function back(place,[x,y]){const c=Math.cos(place.
a),d=Math.sin(place.a);return[c*(x-place.x)+d*(y-place.y),-d*(x-place.x)+c*(y-place.y)]}var normalOf=dyad=>{const angle=radians(dyad.line.normal_deg);return[Math.
cos(angle),Math.sin(angle)]};function constraint(dyad,place){if(dyad.kind==="PP"){const away=place.a-radians(dyad.angle_deg);return[away-2*Math.PI*Math.round(away/
(2*Math.PI)),0,0,1]}if(dyad.kind==="RP"){const[nx2,ny2]=normalOf(dyad);const c=Math.cos(place.a),d=Math.sin(place.a);const tx=c*nx2-d*ny2,ty=d*nx2+c*ny2;const ax=dyad.
fixed_pivot[0]-place.x,ay=dyad.fixed_pivot[1]-place.y;return[tx*ax+ty*ay-dyad.line.offset,-tx,-ty,tx*ay-ty*ax]}const[x,y]=act(place,dyad.moving_pivot);let nx,ny,
residual;if(dyad.kind==="RR"){const ax=x-dyad.fixed_pivot[0],ay=y-dyad.fixed_pivot[1];const size2=Math.hypot(ax,ay)||1;[nx,ny,residual]=[ax/size2,ay/size2,size2-
dyad.radius]}else{[nx,ny]=normalOf(dyad);residual=nx*x+ny*y-dyad.line.offset}return[residual,nx,ny,(x-place.x)*ny-(y-place.y)*nx]}var gradient=(dyad,place)=>constraint(
dyad,place).slice(1);function project(dyads,place,length){let{x,y,a}=place;for(let step=0;step<4;step+=1){const[f,...p]=constraint(dyads[0],{x,y,a});const[g,...q]=constraint(
dyads[1],{x,y,a});p[2]/=length;q[2]/=length;const pp=p[0]*p[0]+p[1]*p[1]+p[2]*p[2];const pq=p[0]*q[0]+p[1]*q[1]+p[2]*q[2];const qq=q[0]*q[0]+q[1]*q[1]+q[2]*q[2];
const det=pp*qq-pq*pq;if(!(det>1e-9*pp*qq))return{x,y,a};const u=(f*qq-g*pq)/det,v=(g*pp-f*pq)/det;x-=u*p[0]+v*q[0];y-=u*p[1]+v*q[1];a-=(u*p[2]+v*q[2])/length;if(Math.
abs(f)+Math.abs(g)<1e-14*length)break}return{x,y,a}}function catmullRom(values,i,share,round){const last=values.length-1;const at=k=>{if(k>=0&&k<=last)return values[k];
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
if(!loads)return[];const ends=loads.springs.flatMap(spring=>spring.ends),on=name=>ends.filter(({link})=>link===name).map(({point:point2})=>point2);return[...on(
"ground"),...places.flatMap(place=>[...on("body"),...loads.hand?[loads.hand]:[]].map(point2=>act(place,point2)))]}function arrowPath([x,y],angle,length){const c=Math.
cos(angle),d=-Math.sin(angle),tip=[x+length*c,y+length*d];const barb=side=>`${px(tip[0]-BARB[0]*c-side*BARB[1]*d)} ${px(tip[1]-BARB[0]*d+side*BARB[1]*c)}`;return`\
M${px(x)} ${px(y)}L${tip.map(px).join(" ")}M${barb(1)}L${tip.map(px).join(" ")}L${barb(-1)}`}var LoadMarks=class{constructor(){this.springs=s("g",{class:"bm-spr\
ings"});this.hand=s("path",{class:"bm-hand"});this.forces=s("g",{class:"bm-pin-forces"});this.group=s("g",{class:"bm-loads"},this.springs,this.hand,this.forces)}shape(data,linkage,view){
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
dataset.pin} ${Number(size2.toPrecision(3))} N`}seen([x,y]){const{view}=this;return view?[view.X(x),view.Y(y)]:[0,0]}endOf({link,point:point2},spring,end,place,drive){
if(link==="ground")return this.seen(point2);if(link==="body")return this.seen(act(place,point2));const known=this.known?.moved.find(each=>each.spring===spring&&
each.end===end);const at=known&&drive!==null?known.at.map(each=>valueAt(each,drive)):[null];return at.some(each=>each===null)?null:this.seen(at)}};var LONGEST_STEP=.015;var MOST_BETWEEN=40;var LEAST_STRETCH=1e-6;function stretchOf(linkage,index,whole=false){const last=(linkage?.ways[index]?.x.length??2)-1,
frames=linkage.pose_errors.filter(row=>row.way===index).map(row=>row.frame);const low=frames.reduce((a,b)=>Math.min(a,b),last),high=frames.reduce((a,b)=>Math.max(
a,b),0);const isApart=high-low>LEAST_STRETCH,sense=frames[frames.length-1]<frames[0]?-1:1;return{...isApart&&!whole?{low,high}:{low:0,high:last},sense,isApart}}
var placesOf=(data,linkage,way,stretch)=>placesAlong(data,stretch,u=>Number.isInteger(u)&&!way.joints?{x:way.x[u],y:way.y[u],a:way.angle[u]}:placeAt(linkage,way,
u,data.chart.length));function placesAlong(data,{low,high},at){const places=[at(low)];let before=low;const goTo=u=>{const next=at(u),last=places[places.length-1];
const count=Math.min(MOST_BETWEEN,Math.floor(Math.hypot(next.x-last.x,next.y-last.y)/(LONGEST_STEP*data.scene)));for(let k=1;k<=count;k+=1)places.push(at(before+
k/(count+1)*(u-before)));places.push(next);before=u};for(let k=Math.floor(low)+1;k<high;k+=1)goTo(k);goTo(high);return places}function driveAtTime({time:{x,y}},time){
return y[0]<=y[y.length-1]?valueAt({x:y,y:x},time):valueAt({x:[...y].reverse(),y:[...x].reverse()},time)}function alongLine(dyad,place){const[nx,ny]=normalOf(dyad);
const[x,y]=dyad.kind==="PR"?act(place,dyad.moving_pivot):back(place,dyad.fixed_pivot);return nx*y-ny*x}function travelOf(dyad,places){const along2=places.map(place=>alongLine(
dyad,place));return[along2.reduce((a,b)=>Math.min(a,b)),along2.reduce((a,b)=>Math.max(a,b))]}function pointOnLine(dyad,along2){const[nx,ny]=normalOf(dyad),{offset}=dyad.
line;return[offset*nx-along2*ny,offset*ny+along2*nx]}var WIDEST=4;var ROOM=2.5;var SPARE=.75;var LEAST2=.25;var MOST_PLACES=400;var INSET=12;var bounds=points=>points.reduce(([x,y,u,v],[a,b])=>Number.isFinite(a+b)?
[Math.min(x,a),Math.min(y,b),Math.max(u,a),Math.max(v,b)]:[x,y,u,v],[Infinity,Infinity,-Infinity,-Infinity]);var placesAtPoses=(data,linkage)=>data.poses.flatMap(
(pose,k)=>{const row=linkage?.pose_errors[k],at=row&&row.x!==null?row:pose;return at.angle_deg===null?[]:[{x:at.x,y:at.y,a:radians(at.angle_deg),k}]});function farFrom(data){
const[x,y,u,v]=bounds(data.poses.map(pose=>[pose.x,pose.y])),reach=(data.body??[]).reduce((most,[a,b])=>Math.max(most,Math.hypot(a,b)),0);return point2=>!(Math.
hypot(point2[0]-(x+u)/2,point2[1]-(y+v)/2)<Math.max(WIDEST*data.scene,reach))}function pivotsAt(linkage,places){const fixed2=linkage.led.flatMap(dyad=>dyad.fixed_pivot?
[dyad.fixed_pivot]:[]);const own=linkage.led.flatMap(dyad=>dyad.moving_pivot?[dyad.moving_pivot]:dyad.kind==="RP"&&places.length?travelOf(dyad,places).map(end=>pointOnLine(
dyad,end)):[]);return[...fixed2,...places.flatMap(place=>[...own.map(point2=>act(place,point2)),...Object.values(place.joints??{})])]}function nearPoints(data,linkage,places,{
far=false,close=false}={}){const isFar=farFrom(data),seen2=point2=>far||!isFar(point2);const reached=linkage?[...linkage.pose_errors.filter(row=>row.x!==null),...places]:
[];const points=[...[...data.poses,...reached].map(({x,y})=>[x,y]),...linkage?[...pivotsAt(linkage,places),...markPoints(data,places)]:[]];const some2=places.filter(
(place,k)=>k%Math.ceil(places.length/MOST_PLACES)===0&&seen2([place.x,place.y]));const corners=data.body&&!close?[...placesAtPoses(data,linkage),...some2].flatMap(
place=>data.body.map(corner=>act(place,corner))):[];return[...points.filter(seen2),...corners]}function fitted(near2,others,whole){const all=bounds([...near2,...others]);
const[x,y,u,v]=bounds(near2),size2=Math.max(u-x,v-y)||1,reach=SPARE*size2;if(whole||!near2.length||Math.max(all[2]-all[0],all[3]-all[1])<=ROOM*size2)return all;
return[Math.max(all[0],x-reach),Math.max(all[1],y-reach),Math.min(all[2],u+reach),Math.min(all[3],v+reach)]}function boxOf(data,linkage,places,{whole=false,close=false}={}){
const near2=nearPoints(data,linkage,places,{far:whole,close}),regions=close?[]:data.keep_out.flatMap(region=>region.outline);const box=fitted(near2,regions,whole||
!linkage),least2=LEAST2*data.scene;for(const k of[0,1]){const lack=Math.max(0,least2-(box[k+2]-box[k]));box[k]-=lack/2;box[k+2]+=lack/2}return box}function viewOf(box,width,height,margin){
const scale=Math.min((width-2*margin)/(box[2]-box[0]),(height-2*margin)/(box[3]-box[1]));const left=width/2-scale*(box[0]+box[2])/2,top=height/2+scale*(box[1]+box[3])/
2;return{scale,left,top,width,height,X:x=>left+scale*x,Y:y=>top-scale*y}}function edgeTowards({X,Y,width,height},at){const x=X(at[0]),y=Y(at[1]),cx=width/2,cy=height/
2;if(x>=0&&y>=0&&x<=width&&y<=height)return null;const size2=Math.hypot(x-cx,y-cy),u=(x-cx)/size2,v=(y-cy)/size2;const reach=Math.min((cx-INSET)/Math.abs(u),(cy-
INSET)/Math.abs(v));return{x:cx+reach*u,y:cy+reach*v,angle:Math.atan2(-v,u)}}var MOST_NAMES=24;var NAME_STEP=5;var MOST_ROWS=40;var NONE="–";function table(caption,heads,rows,attributes){return h("div",{class:"bm-scroll",tabindex:"0",role:"\
region","aria-label":caption},h("table",attributes,h("caption",{},caption),h("thead",{},h("tr",{},heads.map(head2=>h("th",{scope:"col",class:head2.text?"bm-word\
s":null},head2.name??head2)))),h("tbody",{},rows)))}function longTable(caption,heads,rows,attributes){const first=table(caption,heads,rows.slice(0,MOST_ROWS),attributes),
others=rows.slice(MOST_ROWS);if(!others.length)return first;return h("div",{class:"bm-long"},first,h("details",{class:"bm-every"},h("summary",{},`${others.length}\
 more`),table(`${caption}, from ${MOST_ROWS+1}`,heads,others,attributes)))}var cells=(values,words=[],heads=[])=>values.map((value,k)=>k===0?h("th",{scope:"row"},
value):h("td",{class:classes(words.includes(k)&&"bm-words",(value??NONE)===NONE&&"bm-none"),"data-head":heads[k]?.name??heads[k]},value??NONE));var classes=(...names)=>names.
filter(Boolean).join(" ")||null;var UNIT_NAMES={in:"inches",ft:"feet"};var inUnit=data=>data.unit?`, in ${UNIT_NAMES[data.unit]??data.unit}`:"";var unitOf=data=>data.
unit?` (${data.unit})`:"";var decimalsOf=data=>clamp(4-Math.ceil(Math.log10(data.scene)),0,12);var poseName=pose=>pose.label===pose.name?pose.name:`${pose.label}\
: ${pose.name}`;var isPoint=pose=>pose.angle_deg===null;var nounOf=({poses,stop=void 0})=>stop??(poses.length&&poses.every(isPoint)?"point":"pose");var isNamed=({
path:path2,poses},k)=>!path2||poses.length<=MOST_NAMES||k===0||(k+1)%NAME_STEP===0;var calledOf=pose=>pose.called??`${isPoint(pose)?"point":"pose"} ${poseName(pose)}`;
var shortened=(text,most)=>text.length>most?`${text.slice(0,most-1).trimEnd()}…`:text;function missOf(position,angle,unit2){if(position==="-")return"–";const[
away,...share]=position.split(" (");const length=[away==="exact"?away:`${away}${unit2}`,...share].join(" (");return angle==="free"||position==="exact"&&angle===
"exact"?length:`${length} and ${angle}`}function dyadTable(data){const misses=data.poses.some(isPoint)?[]:["rms miss","worst miss"];const heads=["",{name:"kind",
text:true},"on the ground (F)","on the body (M)",`length${unitOf(data)}`,...misses];const rows=data.dyads.map(dyad=>h("tr",{},cells([dyad.id,dyad.kind,dyad.said.
ground,dyad.said.body,dyad.said.length,...misses.length?[dyad.said.rms,dyad.said.worst]:[]],[1],heads)));return longTable(data.dyads_title,heads,rows,{class:"bm\
-stacks"})}function worded(data,{caption,heads,words=[],rows,...how}){const named=heads.map((name,k)=>words.includes(k)?{name,text:true}:name);const lines=cell=>Array.
isArray(cell)?cell.map(part=>h("span",{class:"bm-line-of"},part)):cell;const made2=longTable(caption+(how.lengths?inUnit(data):""),named,rows.map(row=>h("tr",{},
cells(row.map(lines),words,named))),{class:how.class});return how.folded?h("details",{class:"bm-every"},h("summary",{},how.folded),made2):made2}function dimensionRows(linkage){
const uncertain=linkage.said.dimensions.some(row=>row.give);let last=null;return linkage.said.dimensions.map(row=>{const name=row.dyad===last?"":row.dyad;last=row.
dyad;const side=linkage.led.findIndex(dyad=>dyad.id===row.dyad);return h("tr",{},h("th",{scope:"row",class:name?`bm-side${side}`:null},name),h("td",{class:"bm-w\
ords"},row.what),h("td",{},row.value),uncertain?h("td",{},row.give):null)})}function dimensionTable(data,linkage){return table(`Dimensions of ${linkage.id}${inUnit(
data)}`,["",{name:"",text:true},"value",...linkage.said.dimensions.some(row=>row.give)?["± (95 %)"]:[]],dimensionRows(linkage),{class:"bm-dimensions"})}function poseTable(data,linkage){const digits=decimalsOf(data),unit2=unitOf(data),noun=nounOf(data),turned=noun!=="point";const ifTurned=value=>turned?[value]:[];
const heads=[noun,`wanted x`,`y${unit2}`,...ifTurned("angle")];if(linkage)heads.push("body x",`y${unit2}`,"angle","off by",...ifTurned("turned by"),...linkage.columns?.
map(([head2])=>head2)??["transm."],{name:"where",text:true});const rows=data.poses.map((pose,k)=>{const values=[poseName(pose)+(pose.exact?" (exact)":""),fixed(
pose.x,digits),fixed(pose.y,digits),...ifTurned(isPoint(pose)?"free":`${fixed(pose.angle_deg,2)}°`)];if(linkage){const row=linkage.pose_errors[k];values.push(fixed(
row.x,digits),fixed(row.y,digits),row.angle_deg===null?"–":`${fixed(row.angle_deg,2)}°`,row.said.position,...ifTurned(row.said.turned),...linkage.columns?.map(
([,texts])=>texts[k])??[row.said.transmission],row.way===null?"–":wayName(linkage.ways[row.way],linkage))}return h("tr",{"data-pose":k+1},cells(values,[heads.
length-1]))});const what=turned?"Poses":"Points";return table(linkage?`${what}, and where ${linkage.id} takes the body`:what,heads,rows,{class:data.poses.some(pose=>pose.
label!==pose.name)?"bm-pose-table bm-named":"bm-pose-table"})}function imageTables(data,linkage){const digits=decimalsOf(data);const rows=data.poses.filter(pose=>!isPoint(
pose)).map(pose=>{const c=Math.cos(pose.angle_deg*Math.PI/360),d=Math.sin(pose.angle_deg*Math.PI/360);const z=[(pose.x*d-pose.y*c)/2,(pose.x*c+pose.y*d)/2,d,c];
return h("tr",{},cells([pose.label,...z.map((value,k)=>fixed(value,k<2?digits:5))]))});const points=rows.length?[table(`Image points of the poses${unitOf(data)}\
, Z3² + Z4² = 1`,["pose","Z1","Z2","Z3","Z4"],rows)]:[];if(!linkage)return points;const surfaces=linkage.led.map((dyad,k)=>h("tr",{},cells([dyad.id,...linkage.
said.manifolds[k]])));const heads=["",...[1,2,3,4,5,6,7,8].map(k=>`p${k}`)];const caption="Surfaces: p1 (Z1² + Z2²) + p2 Z3² + p3 Z1 Z3 + p4 Z2 Z3 + p5 Z1 Z4 + \
p6 Z2 Z4 + p7 Z3 Z4 + p8 Z4² = 0";return[...points,table(caption,heads,surfaces)]}function wayName(way,linkage){const circuits=new Set(linkage.ways.map(each=>each.
circuit)).size;const parts=[];if(circuits>1||way.branches<2)parts.push(`assembly ${way.circuit}`);if(way.branches>1)parts.push(`branch ${way.branch}`);return parts.
join(", ")}var HATCH=9;var PALEST=.45;var LONGEST_NAME=28;var MANY_GHOSTS=6;var patterns=0;var closed=(points,view,[x,y])=>`M${points.map(each=>`${px(x+view.scale*each[0])}\
 ${px(y-view.scale*each[1])}`).join("L")}Z`;var bodyOutline=(data,view)=>closed(data.body,view,[0,0]);var hasGhost=(k,count)=>count<=MANY_GHOSTS||k===0||k===count-
1;function ghosts(data,linkage,view){const group=s("g",{class:"bm-ghosts"});if(!data.body){for(const row of linkage?.drawn?linkage.pose_errors.filter((_,k)=>hasGhost(
k,linkage.pose_errors.length)):[])group.append(plate(placeAt(linkage,linkage.ways[row.way],row.frame,data.chart.length),linkage,view));return group}const last=Math.
max(1,data.poses.length-1);for(const{x,y,a,k}of placesAtPoses(data,linkage).filter(place=>!linkage||hasGhost(place.k,data.poses.length))){const opacity=(PALEST+
(1-PALEST)*k/last).toFixed(3);group.append(s("path",{class:"bm-ghost",d:bodyOutline(data,view),"data-pose":k+1,opacity,transform:transform(view.X(x),view.Y(y),a)}))}
return group}var plate=(place,{drawn},view)=>s("path",{class:"bm-ghost",d:`${polyline([...drawn.find(({kind})=>kind==="carried").joints].map(joint=>place.joints[joint]??
[place.x,place.y]),view)}Z`});function keepOut(data,view){const group=s("g",{class:"bm-keep-out"});if(!data.keep_out.length)return group;const id=`bm-hatch-${patterns+=
1}`;group.append(s("defs",{},s("pattern",{id,width:HATCH,height:HATCH,patternUnits:"userSpaceOnUse",patternTransform:"rotate(45)"},s("path",{class:"bm-hatch",d:`\
M0 0V${HATCH}`}))));for(const region of data.keep_out){const d=closed(region.outline,view,[view.left,view.top]);group.append(s("g",{class:"bm-region"},s("title",
{},region.name||"keep out"),s("path",{class:"bm-region-plain",d}),s("path",{class:"bm-region-edge",d,fill:`url(#${id})`})))}return group}function keepOutNames(data,view,labels){
return data.keep_out.filter(({name})=>name).map(({name,at:[x,y]})=>{const text=shortened(name,LONGEST_NAME);labels.block(view.X(x),view.Y(y),7.2*text.length,14);
return s("text",{class:"bm-region-name",x:px(view.X(x)),y:px(view.Y(y)+4),"text-anchor":"middle"},text)})}function withKeys(object,changes){const copy={...object,...changes};for(const[key,value]of Object.entries(changes))if(value===void 0)delete copy[key];return copy}
var replaced=(list,index,value)=>list.map((each,k)=>k===index?value:each);var without=(list,index)=>list.filter((_,k)=>k!==index);var inserted=(list,index,value)=>[
...list.slice(0,index),value,...list.slice(index)];var withList=(document2,key,list)=>withKeys(document2,{[key]:list.length?list:void 0});var filled=table3=>Object.
keys(table3).length?table3:void 0;var EXACT={x:0,y:0,angle_deg:0};var FEWEST_TRACED=10;var isFree=(pose,key)=>Boolean(pose?.free?.includes(key))||pose?.tolerance?.[key]===
"free";var isPoint2=pose=>isFree(pose,"angle");var isOfPoints=({poses})=>poses.length>0&&poses.every(isPoint2);var isPath=document2=>isOfPoints(document2)&&(document2.
path!==void 0||document2.poses.length>=FEWEST_TRACED);var setPath=(document2,changes)=>withKeys(document2,{path:withKeys(document2.path??{closed:false},changes)});
var setUsual=(document2,key,value)=>withKeys(document2,{tolerance:{...EXACT,...document2.tolerance,[key]:value??0}});var pathDocument=(document2,points,closed2)=>withKeys(
document2,{poses:points.map(([x,y])=>({x,y,free:["angle"]})),path:{closed:closed2},tolerance:isOfPoints(document2)?document2.tolerance??EXACT:EXACT});var isExact=tolerance=>tolerance&&
["x","y","angle_deg"].every(key=>!tolerance[key]);function settled(document2){const{poses,path:path2,tolerance}=document2,some2=poses.some(pose=>pose.free?.length);
return withKeys(document2,{path:path2&&poses.length&&!poses.every(isPoint2)?void 0:path2,tolerance:some2?tolerance??EXACT:isExact(tolerance)?void 0:tolerance})}
var withCrank=(document2,change)=>document2.path?.crank_deg?setPath(document2,{crank_deg:change(document2.path.crank_deg)}):document2;function betweenCranks(angles,index){
const[a,b]=[angles[index-1],angles[index]];if(a!==void 0&&b!==void 0)return(a+b)/2;return a===void 0?(b??0)-10:a+(a-(angles[index-2]??a-10))}var setPose=(document2,index,changes)=>withKeys(
document2,{poses:replaced(document2.poses,index,withKeys(document2.poses[index],changes))});var addPose=(document2,pose,index=document2.poses.length)=>settled(withCrank(
withKeys(document2,{poses:inserted(document2.poses,index,pose)}),angles=>inserted(angles,index,betweenCranks(angles,index))));var removePose=(document2,index)=>settled(
withCrank(withKeys(document2,{poses:without(document2.poses,index)}),angles=>without(angles,index)));function setAngle(document2,index,angle){const free=angle===
void 0,same=isPoint2(document2.poses[index])===free;return setPose(same?document2:setFree(document2,index,"angle",free),index,{angle})}var setCrank=(document2,index,angle)=>withCrank(
document2,angles=>replaced(angles,index,angle));var duplicatePose=(document2,index)=>addPose(document2,withKeys(document2.poses[index],{name:void 0}),index+1);function movePose(document2,from,to){
const moved=list=>inserted(without(list,from),to,list[from]);return withCrank(withKeys(document2,{poses:moved(document2.poses)}),moved)}function setFree(document2,index,component2,free){
const pose=document2.poses[index],others=(pose.free??[]).filter(each=>each!==component2);const list=free?[...others,component2]:others;const{[component2]:_,[component2===
"angle"?"angle_deg":component2]:bound,...bounds2}=pose.tolerance??{};return settled(setPose(document2,index,{free:list.length?list:void 0,tolerance:free||pose.tolerance?.[component2]===
"free"?filled(bounds2):pose.tolerance}))}var setTolerance=(document2,index,key,bound)=>setPose(document2,index,{tolerance:filled(withKeys(document2.poses[index].
tolerance??{},{[key]:bound}))});var setBody=(document2,corners)=>withList(document2,"body",corners);var bodyOf=document2=>Array.isArray(document2.body)?document2.
body:[];var regionsOf=document2=>document2.keep_out===void 0?[]:[document2.keep_out].flat();var addRegion=(document2,region)=>withList(document2,"keep_out",[...regionsOf(
document2),region]);var setRegion=(document2,index,changes)=>withList(document2,"keep_out",replaced(regionsOf(document2),index,withKeys(regionsOf(document2)[index],
changes)));var removeRegion=(document2,index)=>withList(document2,"keep_out",without(regionsOf(document2),index));var setSurrounding=(document2,key,value)=>withKeys(
document2,{surroundings:filled(withKeys(document2.surroundings??{},{[key]:value}))});var limitsOf=document2=>document2.limits===void 0?[]:[document2.limits].flat();
function setLimit(document2,index,changes){const tables=limitsOf(document2),changed=withKeys(tables[index]??{},changes);const all=index<tables.length?replaced(tables,
index,changed):[...tables,changed];const kept2=all.length>1||filled(changed)?all:[];return withKeys(document2,{limits:kept2.length>1?kept2:kept2[0]})}function splitLimits(document2,apart){
const tables=limitsOf(document2);if(!apart)return withKeys(document2,{limits:tables[0]&&filled(tables[0])});return tables.length>1?document2:withKeys(document2,
{limits:[tables[0]??{},tables[0]??{}]})}var limitRegions=document2=>limitsOf(document2).flatMap((table3,index)=>["fixed_pivot","moving_pivot"].filter(key=>table3[key]).
map(key=>{const[[shape,points]]=Object.entries(table3[key]);return{table:index,key,shape,points:shape==="point"?[points]:points}}));var shapeOf=(shape,points)=>({
[shape]:shape==="point"?points[0]:points});var setRequirement=(document2,key,value)=>withKeys(document2,{requirements:filled(withKeys(document2.requirements??{},
{[key]:value}))});function component(poses,index,key){if(Number.isFinite(poses[index][key]))return poses[index][key];const before=poses.slice(0,index).findLastIndex(
pose=>Number.isFinite(pose[key]));const behind=poses.slice(index+1).findIndex(pose=>Number.isFinite(pose[key]))+index+1;const[a,b]=[poses[before]?.[key],behind>
index?poses[behind][key]:void 0];if(a===void 0||b===void 0)return a??b??0;return a+(index-before)/(behind-before)*(b-a)}function standing({poses},index){const{x,
y,angle}=poses[index];if(Number.isFinite(x)&&Number.isFinite(y)&&Number.isFinite(angle))return{x,y,angle};return{x:component(poses,index,"x"),y:component(poses,
index,"y"),angle:component(poses,index,"angle")}}var poseName2=({poses},index)=>poses[index]?.name??String(index+1);var statedOf=(pose,changes)=>Object.fromEntries(
Object.entries(changes).filter(([key])=>Number.isFinite(pose[key])));var LEAST3=250;var SHARE=8;var Pace=class{timer;constructor(work,wanted=()=>true){this.work=work;this.wanted=wanted;this.free=0;this.timer=null;paces.add(this)}ask(){
if(this.timer!==null||!this.wanted())return;this.timer=setTimeout(()=>this.now(),Math.max(0,this.free-performance.now()))}catchUp(){if(this.timer!==null)this.now()}now(){
clearTimeout(this.timer);this.timer=null;const start=performance.now();this.work();const end=performance.now();this.free=end+Math.max(LEAST3,SHARE*(end-start))}};
var shown=new WeakMap;function isOther(element,facts){const before=shown.get(element);shown.set(element,facts);return before?.length!==facts.length||facts.some(
(fact,k)=>!Object.is(fact,before[k]))}var sights=new WeakMap;var callers=new WeakMap;var observer=null;function watch(element,fn){observer??=new IntersectionObserver(
entries=>{for(const{target,isIntersecting}of entries){sights.set(target,isIntersecting);if(isIntersecting)callers.get(target)?.()}});callers.set(element,fn);observer.
observe(element)}var isSeen=element=>printing||sights.get(element)===true;var paces=new Set;var printing=false;function catchUpForPrint(){addEventListener("befo\
reprint",()=>{printing=true;for(const pace of paces)if(pace.wanted())pace.now()});addEventListener("afterprint",()=>printing=false)}var LETTER=7.2;var HEIGHT=14;var REST=80;var MANY=60;var OUTSIDE=500;var HABIT=6;var MISLEADING=60;var SAME=2;function around(text,toward,distance,few=false){const half=(LETTER*
text.length+4)/2,places=[],count=few?8:16;for(let ring=0;ring<(few?1:3);ring+=1){for(let k=0;k<count;k+=1){const turn=(k%2?1:-1)*Math.ceil(k/2)*(2*Math.PI/count),
angle=toward+turn,away=distance+9*ring;places.push([(away+half-5)*Math.cos(angle),away*Math.sin(angle),3*Math.abs(turn)+14*ring])}}return places}function along(up,width){
const reach=Math.max(0,width/2-30);return[0,-.5,.5,-1,1].flatMap(share=>[[share*reach,up,8*Math.abs(share)],[share*reach,-up,10+8*Math.abs(share)]])}var NamePlaces=class{timer;constructor(scene){
this.scene=scene;this.names=new Map;this.obstacles=[];this.timer=null;scene.on("dropped",()=>this.ask())}avoid(fn){this.obstacles.push(fn)}get areMany(){return this.
names.size>MANY}put(element,x,y,text,places){const before=this.names.get(element),name={x,y,text,places,at:before?.text===text?before.at:places[0]};this.names.set(
element,name);this.show(element,name);this.ask()}ask(){clearTimeout(this.timer);if(!this.scene.dragged)this.timer=setTimeout(()=>this.place(),REST)}show(element,{
x,y,at}){put(element,"text-anchor","middle");put(element,"transform",`translate(${px(x+at[0])} ${px(y-at[1]+4)})`)}place(){if(this.scene.dragged)return;for(const element of[
...this.names.keys()])if(!element.isConnected)this.names.delete(element);const{width,height}=this.scene.view;const seen2=[...this.names].filter(([element,{x,y}])=>x>
-20&&y>-20&&x<width+20&&y<height+20&&element.getAttribute("display")!=="none");const taken=this.obstacles.flatMap(fn=>fn()).map(boxOf2),stands=new Map;for(let pass=0;pass<
(this.areMany?1:2);pass+=1){for(const[element,name]of seen2){stands.delete(element);const others=[...stands.values()];let best={cost:Infinity,at:name.at,box:[0,
0,0,0]};for(const at of name.places){const box=boxAt(name,at);const habit=at[0]===name.at[0]&&at[1]===name.at[1]?HABIT:0;let cost=at[2]-habit;if(box[0]<2||box[1]<
2||box[2]>width-2||box[3]>height-2)cost+=OUTSIDE;for(const other of taken)cost+=overlap(box,other);for(const other of others)cost+=SAME*overlap(box,other);const own=awayFrom(
box,name);if(seen2.some(([,other])=>other!==name&&awayFrom(box,other)<own+1))cost+=MISLEADING;if(cost<best.cost)best={cost,at,box}}name.at=best.at;stands.set(element,
best.box)}}for(const[element,name]of seen2)this.show(element,name)}};var boxOf2=([x,y,width,height])=>[x-width/2,y-height/2,x+width/2,y+height/2];var boxAt=({x,
y,text},at)=>boxOf2([x+at[0],y-at[1],LETTER*text.length+4,HEIGHT]);var awayFrom=(box,{x,y})=>Math.hypot(Math.max(box[0]-x,0,x-box[2]),Math.max(box[1]-y,0,y-box[3]));
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
this.update()}fitAgain(){this.fit(this.isFitted&&!this.isWhole)}closeUp(points){this.isFitted=false;this.fitBox(bounds(points))}reveal(point2){const{view}=this,
margin=Math.min(MARGIN,view.width/8);this.closeUp([point2,[view.x(margin),view.y(margin)],[view.x(view.width-margin),view.y(view.height-margin)]])}grid(){const{
view}=this,{width,height}=view,group=this.layer("grid");const name=this.unit=this.store.document.length_unit,unit2=name?` ${name}`:"";const across=ticks(view.x(
0),view.x(width),width/110),up=ticks(view.y(height),view.y(0),height/80);const lines=[...across.map(({at})=>`M${px(view.X(at))} 0V${height}`),...up.map(({at})=>`\
M0 ${px(view.Y(at))}H${width}`)];const origin=`M${px(clamp(view.X(0),-9,width+9))} 0V${height}M0 ${px(clamp(view.Y(0),-9,height+9))}H${width}`;group.replaceChildren(
s("path",{class:"bs-grid-line",d:lines.join("")}),s("path",{class:"bs-grid-axis",d:origin}),...across.filter(({at})=>view.X(at)>46&&view.X(at)<width-(unit2?54:30)).
map(({at,text})=>s("text",{x:px(view.X(at)),y:height-6,"text-anchor":"middle"},text)),...up.filter(({at})=>view.Y(at)>30&&view.Y(at)<height-24).map(({at,text})=>s(
"text",{x:6,y:px(view.Y(at)-4)},text)),s("text",{x:6,y:14},`y${unit2}`),s("text",{x:width-6,y:height-6,"text-anchor":"end"},`x${unit2}`))}get grain(){return 10**
Math.floor(Math.log10(.35/this.view.scale))}rounded(value){const{grain}=this,digits=clamp(-Math.round(Math.log10(grain)),0,12);return Number((Math.round(value/grain)*
grain).toFixed(digits))+0}get step(){const[x,y,u,v]=bounds(this.store.document.poses.map(pose=>[pose.x??0,pose.y??0]));const span=Math.hypot(u-x,v-y);return Number.
isFinite(span)&&span>0?10**Math.floor(Math.log10(span/50)):1}at(event){if(!this.box){this.box=this.svg.getBoundingClientRect();if(!this.dragged)requestAnimationFrame(
()=>this.dragged||(this.box=null))}const{left,top}=this.box,X=event.clientX-left,Y=event.clientY-top;return{X,Y,x:this.view.x(X),y:this.view.y(Y)}}drag(element,{
start=()=>true,move,end=()=>{},cancel=()=>{},click=()=>{}}){element.addEventListener("pointerdown",event=>{if(event.button!==0||this.tool||this.dragged)return;event.
preventDefault();event.stopPropagation();element.focus?.({preventScroll:true});const from=this.at(event),ended=new AbortController,{signal}=ended;let begun=false;
const stop=finish=>{ended.abort();this.dragged=this.box=null;this.svg.classList.remove("bs-grasped");if(this.svg.hasPointerCapture?.(event.pointerId))this.svg.releasePointerCapture(
event.pointerId);finish();this.emit("dropped")};this.dragged={cancel:()=>stop(()=>begun&&cancel())};this.capture(event);const on=(name,fn)=>this.svg.addEventListener(
name,each=>each.pointerId===event.pointerId&&fn(each),{signal});let last=from,then=event.timeStamp;const go=each=>{const point2=this.at(each);if(point2.X===last.
X&&point2.Y===last.Y)return;last=point2;then=each.timeStamp;if(!begun){if(Math.hypot(point2.X-from.X,point2.Y-from.Y)<CLICK)return;begun=start(from,event)!==false;
if(!begun)return stop(()=>{});this.svg.classList.add("bs-grasped")}move(point2,each)};on("pointermove",go);on("pointerrawupdate",each=>each.timeStamp-then>=RAW&&
go(each));on("pointerup",each=>stop(()=>begun?end(this.at(each)):click(event)));on("pointercancel",()=>stop(()=>begun&&cancel()))})}use(tool){const before=this.
tool;this.tool=tool??null;before?.end?.();this.svg.classList.toggle("bs-drawing",Boolean(tool));this.emit("tool",this.tool);if(tool)this.svg.focus({preventScroll:true})}listen(){
const{svg}=this;svg.addEventListener("wheel",event=>{if(this.zoomKey&&!event.ctrlKey&&!event.metaKey)return;event.preventDefault();const{X,Y}=this.at(event),unit2=event.
deltaMode===1?16:1;this.zoom(ZOOM**(-event.deltaY*unit2*(event.ctrlKey&&!this.zoomKey?4:1)),X,Y)},{passive:false});svg.addEventListener("pointerdown",event=>this.
press(event));svg.addEventListener("pointermove",event=>this.moved(event));for(const name of["pointerup","pointercancel"])svg.addEventListener(name,event=>this.
released(event));svg.addEventListener("keydown",event=>this.key(event))}capture({pointerId}){try{this.svg.setPointerCapture(pointerId)}catch{}}press(event){if(event.
button!==0&&event.button!==1)return;const{X,Y}=this.at(event);this.pointers.set(event.pointerId,{X,Y,from:{X,Y},button:event.button});if(this.pointers.size>1)for(const each of this.
pointers.values())each.panned=true;this.capture(event)}moved(event){const point2=this.at(event),held=this.pointers.get(event.pointerId);if(!held){if(!this.dragged)
this.tool?.hover?.(point2);return}const before={X:held.X,Y:held.Y};Object.assign(held,{X:point2.X,Y:point2.Y});if(this.pointers.size===2){const[one,other]=this.
pointers.values(),still=held===one?other:one;const[now,then]=[point2,before].map(({X,Y})=>Math.hypot(X-still.X,Y-still.Y));if(then>0)this.zoom(now/then,(point2.
X+still.X)/2,(point2.Y+still.Y)/2);return}held.panned||=Math.hypot(point2.X-held.from.X,point2.Y-held.from.Y)>CLICK;if(!held.panned)return;if(this.tool?.drag?.(
point2,held))return;this.svg.classList.add("bs-grasped");this.pan(point2.X-before.X,point2.Y-before.Y)}released(event){const held=this.pointers.get(event.pointerId);
if(!held)return;this.pointers.delete(event.pointerId);this.svg.classList.remove("bs-grasped");const point2=this.at(event);if(event.type==="pointercancel")this.tool?.
hover?.(null);else if(held.panned)this.tool?.release?.(point2,held);else if(held.button===0)this.tool?this.tool.click(point2,event):this.emit("click",point2,event)}key(event){
if(event.target!==this.svg||event.ctrlKey||event.metaKey||event.altKey)return;const by=event.shiftKey?160:40,{width,height}=this.size;const steps={ArrowLeft:[by,
0],ArrowRight:[-by,0],ArrowUp:[0,by],ArrowDown:[0,-by]};if(steps[event.key])this.pan(...steps[event.key]);else if(event.key==="+"||event.key==="=")this.zoom(1.25,
width/2,height/2);else if(event.key==="-")this.zoom(.8,width/2,height/2);else if(event.key==="0")this.fitAgain();else if(event.key==="z")this.emit("closer");else
return;event.preventDefault()}};var Kept=class{constructor(group,make,show){this.group=group;this.make=make;this.show=show;this.elements=new Map}draw(items){const kept2=new Map;
for(const[key,item]of items){const element=this.elements.get(key)??this.make(key,item);kept2.set(key,element);this.show(element,item)}for(const[key,element]of this.
elements)if(!kept2.has(key))element.remove();let before=null;for(const element of kept2.values()){const next=before?before.nextSibling:this.group.firstChild;if(element!==
next||element.parentNode!==this.group)this.group.insertBefore(element,next);before=element}this.elements=kept2}};var cross=([a,b],[c,d])=>a*d-b*c;var minus=([a,b],[c,d])=>[a-c,b-d];var size=([a,b])=>Math.hypot(a,b);function fromSegment(point2,start,end){const along2=minus(
end,start),away=minus(point2,start),square=along2[0]**2+along2[1]**2;const share=square>0?Math.min(1,Math.max(0,(along2[0]*away[0]+along2[1]*away[1])/square)):0;
return size(minus(away,[share*along2[0],share*along2[1]]))}var boxCorners=([[a,b],[c,d]])=>[[a,b],[c,b],[c,d],[a,d]];var outlineOf=(shape,points)=>shape==="box"?
boxCorners(points):points;function isInside([x,y],corners){let inside2=false;corners.forEach(([a,b],k)=>{const[c,d]=corners[(k+1)%corners.length];if(b>y!==d>y&&
x<a+(y-b)/(d-b)*(c-a))inside2=!inside2});return inside2}function distanceTo(point2,shape,points){if(shape==="point")return size(minus(point2,points[0]));if(shape===
"segment")return fromSegment(point2,...points);if(shape==="line"){const along2=minus(points[1],points[0]);return Math.abs(cross(along2,minus(point2,points[0])))/
size(along2)}const corners=outlineOf(shape,points);if(isInside(point2,corners))return 0;return Math.min(...corners.map((corner,k)=>fromSegment(point2,corner,corners[(k+
1)%corners.length])))}var crosses=(a,b,c,d)=>{const turn=(p,q,r)=>Math.sign(cross(minus(q,p),minus(r,p)));return turn(a,b,c)*turn(a,b,d)<0&&turn(c,d,a)*turn(c,d,
b)<0};var edges=corners=>corners.map((corner,k)=>[corner,corners[(k+1)%corners.length]]);function overlap2(one,other){if(isInside(one[0],other)||isInside(other[0],
one))return true;return edges(one).some(([a,b])=>edges(other).some(([c,d])=>crosses(a,b,c,d)))}function segmentFromPolygon([start,end],corners){if(isInside(start,
corners)||edges(corners).some(([c,d])=>crosses(start,end,c,d)))return 0;return Math.min(...edges(corners).map(([c,d])=>Math.min(fromSegment(start,c,d),fromSegment(
end,c,d),fromSegment(c,start,end),fromSegment(d,start,end))))}var ARROWS={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]};var LEAST_CORNERS=3;var CLOSED=new Set(["box","polygon"]);var GROUND={x:0,y:0,a:0};
function pathOf(shape,points,place,view){const seen2=outlineOf(shape,points).map(point2=>act(place,point2)).map(([x,y])=>[view.X(x),view.Y(y)]);if(shape==="poin\
t")return`M${px(seen2[0][0]-7)} ${px(seen2[0][1])}h14m-7 -7v14`;if(shape==="line"){const[[a,b],[c,d]]=seen2,size2=Math.hypot(c-a,d-b)||1,far=view.width+view.height+
Math.hypot(a,b);const[u,v]=[far*(c-a)/size2,far*(d-b)/size2];return`M${px(a-u)} ${px(b-v)}L${px(c+u)} ${px(d+v)}`}return`M${seen2.map(point2=>point2.map(px).join(
" ")).join("L")}${CLOSED.has(shape)?"Z":""}`}function withCorner(shape,points,k,to){if(shape!=="box")return points.map((point2,i)=>i===k?to:point2);const opposite=boxCorners(
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
x,y}){return back(this.now.place,[x,y]).map(each=>this.scene.rounded(each))}dragWhole(){let gesture,from,before;this.scene.drag(this.area,{start:point2=>{gesture=
Symbol("move a shape");from=back(this.now.place,[point2.x,point2.y]);before=this.now.points},move:point2=>{const to=back(this.now.place,[point2.x,point2.y]),by=[
to[0]-from[0],to[1]-from[1]];this.set(before.map(([x,y])=>[this.scene.rounded(x+by[0]),this.scene.rounded(y+by[1])]),gesture)},cancel:()=>this.abandon(gesture),
click:()=>this.select()})}makeCorner(k){const circle=s("circle",{class:"bs-corner",r:6,tabindex:0,role:"button","data-corner":k+1});let gesture;this.scene.drag(
circle,{start:()=>(gesture=Symbol("move a corner"))&&true,move:point2=>this.set(withCorner(this.now.shape,this.now.points,k,this.point(point2)),gesture),cancel:()=>this.
abandon(gesture)});circle.addEventListener("keydown",event=>this.keys(event,(points,by)=>{const[x,y]=outlineOf(this.now.shape,points)[k];return withCorner(this.
now.shape,points,k,[stepped(x,by[0]),stepped(y,by[1])])},()=>this.removeCorner(k)));return circle}removeCorner(k){const{shape,points}=this.now;if(shape!=="polyg\
on"||points.length<=LEAST_CORNERS)return;this.set(points.filter((_,i)=>i!==k),null)}makeMiddle(k){const circle=s("circle",{class:"bs-middle",r:4.5,"data-edge":k+
1});let gesture;this.scene.drag(circle,{start:()=>{gesture=Symbol("add a corner");this.set([...this.now.points.slice(0,k+1),this.now.points[k],...this.now.points.
slice(k+1)],gesture)},move:point2=>this.set(withCorner("polygon",this.now.points,k+1,this.point(point2)),gesture),cancel:()=>this.abandon(gesture)});return circle}showCorner(element,k){
const corner=outlineOf(this.now.shape,this.now.points)[k];for(const[name,value]of Object.entries(this.at(corner)))put(element,name,value);put(element,"aria-labe\
l",`Corner ${k+1} of ${this.now.name}: ${corner.join(", ")}`)}showMiddle(element,k){const{points}=this.now,next=points[(k+1)%points.length];const middle2=this.at(
[(points[k][0]+next[0])/2,(points[k][1]+next[1])/2]);for(const[name,value]of Object.entries(middle2))put(element,name,value)}keys(event,moved,remove){if(event.ctrlKey||
event.metaKey)return;const arrow2=ARROWS[event.key];if(arrow2){if(!event.repeat)this.keyed=Symbol("keys");const by=stepOf(event,this.scene.step);this.set(moved(
this.now.points,[by*arrow2[0],by*arrow2[1]]),this.keyed)}else if(event.key==="Delete"||event.key==="Backspace"){remove()}else{return}event.preventDefault();event.
stopPropagation()}};var CLOSE=12;var PAIRS=new Set(["segment","line","box"]);var HINTS={point:"Click the point. Enter puts it in the middle, Escape gives up.",segment:"Click both e\
nds. Enter puts one in the middle, Escape gives up.",line:"Click two points of the line. Enter puts one in the middle, Escape gives up.",box:"Drag from corner t\
o corner, or click both. Enter puts one in the middle, Escape gives up.",polygon:"Click the corners; Enter or a click on the first one closes. Backspace takes t\
he last one back, Escape gives up."};var MIDDLE={point:[[0,0]],segment:[[-1,0],[1,0]],line:[[-1,0],[1,0]],box:[[-1,-1],[1,1]],polygon:[[-1,-1],[1,-1],[0,1]]};var SHARE2=.12;
var ordered=([[a,b],[c,d]])=>[[Math.min(a,c),Math.min(b,d)],[Math.max(a,c),Math.max(b,d)]];var isFlat=([[a,b],[c,d]])=>a===c&&b===d;var ShapeTool=class{constructor(scene,{
shape,place,done,name}){this.scene=scene;this.shape=shape;this.place=place;this.done=done;this.name=name;this.points=[];this.next=null;this.hint=HINTS[shape];this.
path=s("path",{class:"bs-draft"});this.dots=s("g");this.element=s("g",{},this.path,this.dots);scene.layer("tool").append(this.element)}point({x,y}){return back(
this.place(),[x,y]).map(each=>this.scene.rounded(each))}click(point2,event){const next=this.point(point2);if(this.shape==="polygon"){if(this.points.length>2&&(this.
isFirst(point2)||event?.detail>1))return this.finish(this.points);if(this.points.length&&isFlat([this.points.at(-1),next]))return void 0}this.points.push(next);
if(this.shape==="point"||PAIRS.has(this.shape)&&this.points.length===2)return this.finish(this.points);return this.draw()}isFirst({X,Y}){const[x,y]=act(this.place(),
this.points[0]),{view}=this.scene;return Math.hypot(view.X(x)-X,view.Y(y)-Y)<CLOSE}hover(point2){this.next=point2&&this.point(point2);this.draw()}drag(point2,held){
if(!PAIRS.has(this.shape)||this.points.length)return false;this.dragging=[this.point(this.inPlane(held.from)),this.point(point2)];this.draw();return true}inPlane({
X,Y}){return{x:this.scene.view.x(X),y:this.scene.view.y(Y)}}inMiddle(){const{width,height}=this.scene.size,half=SHARE2*Math.min(width,height);return MIDDLE[this.
shape].map(([x,y])=>this.point(this.inPlane({X:width/2+half*x,Y:height/2-half*y})))}release(){if(!this.dragging)return;const pair=this.dragging;this.dragging=null;
this.finish(pair)}finish(points){if(PAIRS.has(this.shape)&&isFlat(points)){this.points=points.slice(0,1);return this.draw()}this.scene.use(null);return this.done(
this.shape==="box"?ordered(points):points)}key(event){if(event.key==="Escape")this.scene.use(null);else if(event.key==="Backspace")this.points.pop();else if(event.
key==="Enter"&&!this.points.length)this.finish(this.inMiddle());else if(event.key==="Enter"&&this.points.length>2)this.finish(this.points);else return false;this.
draw();return true}draw(){const{scene:{view},shape}=this,shown2=this.dragging??[...this.points,...this.next?[this.next]:[]];const place=this.place(),whole=shape===
"polygon"?"open polygon":shape;const complete=shown2.length>1||shape==="point";put(this.path,"d",complete&&shown2.length?pathOf(whole,shown2,place,view):"");this.
dots.replaceChildren(...(this.dragging??this.points).map(point2=>act(place,point2)).map(([x,y],k)=>s("circle",{class:k?"bs-draft-dot":"bs-draft-dot bs-first",r:4,
cx:px(view.X(x)),cy:px(view.Y(y))})))}end(){this.element.remove()}};var PALEST2=.4;function referenceIndex(store){const{selection,document:document2}=store;if(selection?.kind==="pose"&&selection.index<document2.poses.length)store.
reference=selection.index;return Math.min(store.reference??0,document2.poses.length-1)}function referencePlace(store){const k=referenceIndex(store);if(k<0)return{
x:0,y:0,a:0};const{x,y,angle}=standing(store.document,k);return{x,y,a:radians(angle)}}var BodyEditor=class{constructor(store,scene){this.store=store;this.scene=
scene;this.ghosts=new Kept(s("g",{class:"bs-ghosts","aria-hidden":"true"}),()=>s("path",{class:"bs-ghost"}),(path2,item)=>this.showGhost(path2,item));scene.layer(
"ghosts").append(this.ghosts.group);this.handles=new ShapeHandles(scene,{className:"bs-body-shape",what:()=>({shape:"polygon",points:bodyOf(store.document),place:referencePlace(
store),name:"Outline of the body",selected:store.selection?.kind==="body",data:{body:""}}),set:(points,gesture)=>store.edit(document2=>setBody(document2,points),
{gesture}),remove:()=>store.edit(document2=>setBody(document2,[])),select:()=>store.select({kind:"body",index:0}),abandon:gesture=>store.abandon(gesture)});store.
on("document selection",()=>this.draw());scene.on("view",()=>this.draw());this.draw()}indices(){const{document:{poses},selection}=this.store,chosen=selection?.kind===
"pose"?selection.index:null;return poses.map((_,k)=>k).filter(k=>hasGhost(k,poses.length)||k===chosen)}draw(){const body=bodyOf(this.store.document),{scale}=this.
scene.view;this.path=body.length?`M${body.map(([x,y])=>`${px(scale*x)} ${px(-scale*y)}`).join("L")}Z`:"";this.ghosts.draw(body.length?this.indices().map(k=>[k,k]):
[]);if(!body.length||!this.store.document.poses.length)return this.handles.clear();if(!this.handles.element.parentNode)this.scene.layer("ghosts").append(this.handles.
element);return this.handles.draw()}showGhost(path2,k){const{view}=this.scene,{x,y,angle}=standing(this.store.document,k),last=Math.max(1,this.store.document.poses.
length-1);if(!isOther(path2,[view,x,y,angle,k/last,this.path]))return;put(path2,"d",this.path);put(path2,"opacity",(PALEST2+(1-PALEST2)*k/last).toFixed(3));put(
path2,"transform",transform(view.X(x),view.Y(y),radians(angle)))}tool(){return new ShapeTool(this.scene,{shape:"polygon",name:"body",place:()=>referencePlace(this.
store),done:points=>{this.store.edit(document2=>setBody(document2,points));this.store.select({kind:"body",index:0})}})}};var ROUNDING=1e-6;var MOST_PLACES2=90;var KEYS=["fixed_pivot","moving_pivot"];function currentLinkage(store){if(store.chosen==="placed")return store.placed?.linkage??
null;const followed=store.followed?.linkages.find(({id})=>id===store.chosen);if(followed?.led)return followed;if(store.followed?.vanished?.some(({id})=>id===store.
chosen))return null;return store.solved?.linkages.find(({id})=>id===store.chosen)??null}var PIVOT={fixed_pivot:"fixed pivot",moving_pivot:"moving pivot"};function missed(table3,dyad,slack){
const found=[];for(const key of KEYS){if(!table3[key])continue;const[[shape,stated]]=Object.entries(table3[key]),points=shape==="point"?[stated]:stated;const away=dyad[key]?
distanceTo(dyad[key],shape,points):Infinity;if(away>slack)found.push({key,dyad:dyad.id,away})}const{least:least2=0,most=Infinity}=table3.length??{};if(table3.length&&
dyad.kind==="RR"&&(dyad.radius<least2-slack||dyad.radius>most+slack)){found.push({key:"length",dyad:dyad.id,away:Math.max(least2-dyad.radius,dyad.radius-most)})}
if(table3.kinds&&!table3.kinds.includes(dyad.kind))found.push({key:"kinds",dyad:dyad.id,away:Infinity});return found}function limitsMissed(document2,linkage,size2){
const tables=limitsOf(document2),slack=ROUNDING*size2,[one,other]=linkage.led;if(tables.length<2)return tables.map(table3=>[...missed(table3,one,slack),...missed(
table3,other,slack)]);const pairings=[[one,other],[other,one]].map(dyads=>dyads.map((dyad,k)=>missed(tables[k],dyad,slack)));const total=lists=>lists.flat().length;
return total(pairings[1])<total(pairings[0])?pairings[1]:pairings[0]}function missedSentence({key,dyad,away},unit2){const by=`${Number(away.toPrecision(2))}${unit2?
` ${unit2}`:""}`;if(key==="kinds")return`${dyad} is of another kind.`;if(key==="length")return`The link of ${dyad} is ${by} beyond its range.`;return away===Infinity?
`${dyad} has no ${PIVOT[key]}.`:`The ${PIVOT[key]} of ${dyad} is ${by} outside.`}function usedPlaces(linkage){const rows=(linkage.pose_errors??[]).filter(row=>row.
way!==null&&row.frame!==null);if(!rows.length||!linkage.ways?.length)return[];const counts=new Map;for(const{way:way2}of rows)counts.set(way2,(counts.get(way2)??
0)+1);const[best]=[...counts].sort((a,b)=>b[1]-a[1])[0],way=linkage.ways[best];const frames=rows.filter(row=>row.way===best).map(({frame})=>frame);const low=Math.
floor(Math.min(...frames)),high=Math.ceil(Math.max(...frames)),stride=Math.max(1,Math.ceil((high-low)/MOST_PLACES2));const places=[];for(let k=low;k<=high&&k<way.
x.length;k+=stride)places.push({x:way.x[k],y:way.y[k],a:way.angle[k]});return places}var regionCorners=region=>region.polygon??(region.box?boxCorners(region.box):
null);var seen=(body,place)=>body.map(corner=>act(place,corner));function posePlace(document2,k){const{x,y,angle}=standing(document2,k);return{x,y,a:radians(angle)}}
function regionsTouched(document2,linkage,body){const places=usedPlaces(linkage),width=document2.surroundings?.link_width??0,margin=document2.surroundings?.margin??
0;const apart=Math.ceil(document2.poses.length/MOST_PLACES2),some2=[...document2.poses.keys()].filter(k=>k%apart===0);return regionsOf(document2).map(region=>{const corners=regionCorners(
region);if(!corners)return"";const pose=body.length>2?some2.find(k=>overlap2(seen(body,posePlace(document2,k)),corners)):void 0;if(pose!==void 0)return`The body\
 touches it at pose ${poseName2(document2,pose)}.`;if(!places.length)return"";if(body.length>2&&places.some(place=>overlap2(seen(body,place),corners)))return"Th\
e body touches it.";for(const dyad of linkage.led){if(dyad.kind!=="RR")continue;const near2=Math.min(...places.map(place=>segmentFromPolygon([dyad.fixed_pivot,act(
place,dyad.moving_pivot)],corners)));if(near2===0||near2<width/2)return`The link of ${dyad.id} touches it.`;if(near2<width/2+margin)return`The link of ${dyad.id}\
 comes nearer than the margin.`}return""})}var AGAIN=[250,500,1e3,2e3,4e3];var KEY3="burmester.studio.key";var UNFINISHED=new Set(["solving","progress","waiting"]);var Refused=class extends Error{constructor(status,messages){
super(messages.map(each=>each.message).join(" ")||`the server answered ${status}`);this.status=status;this.messages=messages}};async function messagesOf(response){
try{return(await response.json()).messages??[]}catch{return[]}}var Connection=class{socket;constructor(decode){this.decode=decode;this.listeners={message:[],open:[],
closed:[]};this.asked=new Map;this.n=0;this.tries=0;this.socket=null}on(name,fn){this.listeners[name].push(fn)}emit(name,value){for(const fn of this.listeners[name])
fn(value)}get isOpen(){return this.socket?.readyState===1}get key(){try{return localStorage.getItem(KEY3)??this.own}catch{return this.own}}async session(){const token=decodeURIComponent(
location.hash.slice(1)).replace(/^token=/,"");if(!token)return;history.replaceState(null,"",location.pathname);try{this.own=(await(await this.post("/session",{token})).
json()).key}catch(error){if(!(error instanceof Refused)||!this.key)throw error;return}try{localStorage.setItem(KEY3,this.own)}catch{}}async get(path2){return(await this.
request(path2,{})).json()}post(path2,body,method="POST"){return this.request(path2,{method,headers:{"Content-Type":"application/json"},body:JSON.stringify(body)})}async request(path2,options){
const headers={...options.headers,Authorization:`Bearer ${this.key}`};const response=await fetch(path2,{credentials:"omit",...options,headers});if(!response.ok)
throw new Refused(response.status,await messagesOf(response));return response}open(){clearTimeout(this.timer);this.socket?.close();const socket=new WebSocket(`${location.
protocol==="https:"?"wss":"ws"}://${location.host}/live`,["burmester",this.key]);socket.binaryType="arraybuffer";this.socket=socket;socket.onopen=()=>{this.tries=
0;this.emit("open")};socket.onmessage=({data})=>{if(socket===this.socket)this.take(typeof data==="string"?JSON.parse(data):this.decode(data))};socket.onclose=()=>{
if(socket!==this.socket)return;for(const{reject}of this.asked.values())reject(new Error("the connection ended"));this.asked.clear();this.emit("closed",this.tries);
this.timer=setTimeout(()=>this.open(),AGAIN[Math.min(this.tries,AGAIN.length-1)]);this.tries+=1}}take(message){const waiting=this.asked.get(message.n);if(waiting&&
!UNFINISHED.has(message.kind)){this.asked.delete(message.n);waiting.resolve(message)}this.emit("message",message)}send(message){if(!this.isOpen)return null;this.
n+=1;this.socket.send(JSON.stringify({n:this.n,...message}));return this.n}ask(message){return new Promise((resolve,reject)=>{const n=this.send(message);if(n===
null)reject(new Error("the connection is closed"));else this.asked.set(n,{resolve,reject})})}};var DRAWINGS=/\.(svg|dxf)$/i;var TASKS=/\.(toml|json)$/i;var KINDS=".toml,.json,.csv,.tsv,.txt,.xlsx,.parquet,.trc,.svg,.dxf";var BESIDE=["limits","requirements",
"keep_out","surroundings","body"];var HEADERS={2:["x,y","Read them as x, y: points"],3:["x,y,angle_deg","Read them as x, y, angle in degrees"]};var LARGEST=14e5;
async function base64Of(file){const bytes=new Uint8Array(await file.arrayBuffer());let text="";for(let k=0;k<bytes.length;k+=32768)text+=String.fromCharCode(...bytes.
subarray(k,k+32768));return btoa(text)}var isTable=text=>/\d/.test(text)&&(/\t/.test(text)||/\n\s*\S/.test(text.trim()));function download(blob,name){const address=URL.
createObjectURL(blob),link=h("a",{href:address,download:name});link.click();setTimeout(()=>URL.revokeObjectURL(address),1e4)}function popover(text,list,fill,attributes={}){
const summary=h("summary",{class:"bm-button"},text),element=h("details",{class:"bs-menu",...attributes},summary,list);const close=()=>{if(!element.open)return;element.
open=false;summary.focus()};element.addEventListener("toggle",()=>element.open&&fill(close));element.addEventListener("keydown",event=>{const all=[...list.querySelectorAll(
".bs-menu-item")],at=all.indexOf(document.activeElement),step={ArrowDown:1,ArrowUp:-1}[event.key];if(event.key==="Escape")close();else if(step&&(at>=0||document.
activeElement===summary))all[(at+step+all.length)%all.length]?.focus();else return;event.preventDefault();event.stopPropagation()});document.addEventListener("p\
ointerdown",event=>element.contains(event.target)||(element.open=false));return element}var menuItem=({title,note,act:act2,data},close,attributes={})=>h("button",
{type:"button",class:"bs-menu-item",...attributes,...data,onclick:()=>(close(),act2())},h("b",{},title),note?h("span",{},note):null);function menu(text,items,attributes={}){
const list=h("div",{class:"bs-menu-list",role:"menu"});return popover(text,list,close=>list.replaceChildren(...items().map(each=>each.heading?h("p",{class:"bs-m\
enu-heading",role:"presentation"},each.heading):menuItem(each,close,{role:"menuitem"}))),attributes)}var Files=class{opened;constructor(store,start,banners){this.
store=store;this.start=start;this.banners=banners;this.server=store.connection;this.chooser=h("input",{type:"file",hidden:true,accept:KINDS,"data-file":"open",onchange:()=>this.
chosen(this.chooser)});this.outlines=h("input",{type:"file",hidden:true,accept:".svg,.dxf","data-file":"outline",onchange:()=>this.chosen(this.outlines)});this.
dropping=h("div",{class:"bs-dropping",hidden:true,"aria-hidden":"true"},h("p",{},"Drop a task, a table of poses, or the outline of the body"));this.dialog=h("di\
alog",{class:"bs-dialog","aria-label":"The same from the command line"});this.element=h("div",{class:"bs-files"},this.menu(),this.chooser,this.outlines,this.dropping,
this.dialog);this.listen()}menu(){const item=(title,note,act2,data)=>({title,note,act:act2,data:{"data-do":data}});return menu("Task",()=>[item("New","an empty \
task",()=>this.fresh(),"new"),item("Open…","a task, or a table of poses (Ctrl+O)",()=>this.chooser.click(),"open"),item("Save task","the file that the command\
 reads (Ctrl+S)",()=>this.save(),"save"),item("Copy as command","the same from the command line",()=>this.commands(),"command"),{heading:"Templates"},...(this.start.
templates??[]).map(({name,summary})=>({title:name,note:summary,act:()=>this.template(name),data:{"data-template":name}}))],{"data-menu":"task"})}get task(){const{
document:document2,options,name}=this.store;return{document:document2,options,name}}async trying(what,then,actions=[]){try{return await then()}catch(error){if(error instanceof
Refused&&error.messages.length)this.banners.say("refused",`${what} was not done.`,error.messages,{actions});else this.banners.say("refused",`${what} was not don\
e: ${error instanceof Refused?error.message:"the server does not answer"}.`);return null}}fresh(){this.store.replace({document:{length_unit:"mm",angle_unit:"deg",
poses:[]},options:{},name:"task"})}template(name){return this.trying(`Opening ${name}`,async()=>{const made2=await this.server.get(`/template/${encodeURIComponent(
name)}`);this.store.replace({name,...made2});this.opened?.()})}async chosen(input){for(const file of input.files)await this.take(file,input===this.outlines);input.
value=""}chooseOutline(){this.outlines.click()}take(file,asOutline=DRAWINGS.test(file.name)&&this.store.document.poses.length>0&&!isPath(this.store.document)){const isDrawing=DRAWINGS.
test(file.name),{document:before}=this.store;const other=isDrawing?button(asOutline?"Take it as a path to trace":"Take it as the outline of the body",()=>{for(const kind of[
"note","refused"])this.banners.close(kind);if(this.store.document!==before)this.store.undo();this.take(file,!asOutline)},{"data-do":asOutline?"as-path":"as-outl\
ine"}):null;return this.trying(`Reading ${file.name}`,async()=>{if(file.size>LARGEST)throw new Refused(413,[{message:`${file.name} has ${Math.round(file.size/1e3)}\
 kB, and the page takes ${LARGEST/1e3}.`,help:"give it to the command: burmester studio FILE"}]);const body={name:file.name,base64:await base64Of(file),length_unit:this.
store.document.length_unit};if(asOutline)return this.outline(await(await this.server.post("/outline",body)).json(),file.name,other);const{document:document2,options={},
notes=[]}=await(await this.server.post("/read",body)).json();const name=file.name.replace(/\.[^.]*$/,"");const whole=TASKS.test(file.name);this.store.replace(whole?
{document:document2,options,name}:{document:document2,options:this.store.options,name});this.opened?.();return this.banners.say("note",`${file.name} is open.`,notes,
{undo:true,actions:other?[other]:[]})},other?[other]:[])}outline({outline:corners,notes=[]},name,other){this.store.edit(document2=>setBody(document2,corners));this.
store.select({kind:"body",index:0});this.banners.say("note",`The outline of the body is that in ${name}: ${corners.length} corners.`,notes,{undo:true,actions:other?
[other]:[]})}paste(text,columns){const[first]=text.trim().split("\n"),header=HEADERS[first.trim().split(/\t/.test(first)?/\t/:/[,;\s]+/).length];const again=!columns&&
header&&!/[^\d\s.,;+\-eE\u2212]/.test(first)?[button(header[1],()=>(this.banners.close("refused"),this.paste(text,header[0])),{"data-do":"read-columns"})]:[];return this.
trying("Pasting",async()=>{const old=this.store.document;const{document:document2,notes=[]}=await(await this.server.post("/read",{name:"pasted",text,columns,length_unit:old.
length_unit,angle_unit:"deg"})).json();const beside=Object.fromEntries(BESIDE.filter(key=>old[key]!==void 0&&document2[key]===void 0).map(key=>[key,old[key]]));
this.store.replace({document:withKeys(document2,{length_unit:document2.length_unit??old.length_unit}),options:this.store.options});this.store.select(null);this.
opened?.();this.banners.close("refused");const keep=button("Keep the limits and the body of the task before",()=>(keep.remove(),this.store.edit(now=>withKeys(now,
beside))),{"data-do":"keep-rest"});const what=document2.poses.some(pose=>pose.angle!==void 0)?"poses":"points";this.banners.say("note",`${document2.poses.length}\
 ${what} were pasted.`,notes,{undo:true,actions:Object.keys(beside).length?[keep]:[]})},again)}save(){return this.trying("Saving",async()=>{try{await this.hand(
await this.server.post("/task",this.task),`${this.store.name}.toml`)}catch(error){if(error instanceof Refused)throw error;this.saveWithoutServer();this.banners.
say("note","The server does not answer: the task was saved as JSON, which the command reads as well.")}})}saveWithoutServer(){download(new Blob([`${JSON.stringify(
this.store.document,null,2)}
`],{type:"application/json"}),`${this.store.name.replace(/[^\w.-]+/g,"-")||"task"}.json`)}get chosenLinkage(){const{chosen,placed}=this.store,dyads=chosen==="pl\
aced"?placed?.linkage?.dyads:void 0;if(!dyads?.every(dyad=>dyad.kind==="RR"))return{linkage:chosen==="placed"?null:chosen};return{linkage:null,dyads:dyads.map(({
fixed_pivot,moving_pivot,radius})=>({fixed_pivot,moving_pivot,radius}))}}export(path2,what={}){return this.trying("Exporting",async()=>{this.hand(await this.server.
post(path2,{...this.task,...this.chosenLinkage,settings:this.store.settings,...what}),"export")})}async hand(response,otherwise){const name=/filename="([^"]+)"/.
exec(response.headers.get("Content-Disposition")??"")?.[1]??otherwise;download(await response.blob(),name)}commands(){return this.trying("Copying",async()=>{const{
commands}=await(await this.server.post("/command",{...this.task,settings:this.store.settings,...this.chosenLinkage})).json();const close=button("Close",()=>this.
dialog.close(),{"data-do":"close"});const said=h("p",{class:"bs-hint",role:"status"});const copy=async command=>{try{await navigator.clipboard.writeText(command);
said.textContent="Copied."}catch{said.textContent="The browser does not let this page copy: select the text."}};this.dialog.replaceChildren(h("h2",{},"The same \
from the command line"),h("p",{class:"bs-hint"},"Save the task first; the commands read that file."),...commands.map(({title,command})=>h("div",{class:"bs-comma\
nd"},h("h3",{},title),h("pre",{tabindex:0},command),button("Copy",()=>copy(command),{"aria-label":`Copy: ${title}`}))),h("div",{class:"bs-row"},close,said));this.
dialog.showModal()})}listen(){let inside2=0;const hasFiles=event=>[...event.dataTransfer?.types??[]].includes("Files");const show=by=>{inside2=Math.max(0,inside2+
by);give(this.dropping,"hidden",inside2===0)};document.addEventListener("dragenter",event=>hasFiles(event)&&(event.preventDefault(),show(1)));document.addEventListener(
"dragover",event=>hasFiles(event)&&event.preventDefault());document.addEventListener("dragleave",event=>hasFiles(event)&&show(-1));document.addEventListener("dr\
op",async event=>{if(!hasFiles(event))return;event.preventDefault();show(-Infinity);inside2=0;for(const file of event.dataTransfer?.files??[])await this.take(file)});
document.addEventListener("paste",event=>{const text=event.clipboardData?.getData("text/plain")??"",[file]=event.clipboardData?.files??[];const typing=event.target instanceof
HTMLElement&&event.target.closest("input, textarea, select");if(file)this.take(file);else if(isTable(text))this.paste(text);else return;event.preventDefault();if(typing)
typing.blur()})}};var LENGTHS2=[["hole","holes"],["pin","pins"],["width","links are wide"],["thickness","plates are thick"],["gap","gap between plates"]];var NUMBERS=[["pose","dr\
awn at pose","1",{least:1,whole:true}],["density","density, kg/m³","2700",{above:0}],["seconds","film, seconds","4",{above:0}],["frames_per_second","pictures a\
 second","25",{above:0}],["width_px","pixels wide","800",{least:1,whole:true}]];var AXES=["y","x","z","-x","-y","-z"];var UNITS=["mm","cm","m","in","ft"];var USES={
cut:"Cut",print:"Print",cad:"CAD",simulate:"Simulate",film:"Film",share:"Share"};var ExportSettings=class{constructor(store,scene,formats,files){this.store=store;
const set=name=>value=>store.setting(name,value);this.fields=new Map;const number=(name,placeholder,options)=>{const field=new NumberField({label:name.replace(/_/g,
" "),commit:set(name),options:()=>({optional:true,unit:store.document.length_unit,...options}),step:()=>options.kind?scene.step:1,attributes:{"data-setting":name,
placeholder}});this.fields.set(name,field);return field.element};this.unit=choice("unit of what is exported",UNITS.map(unit2=>[unit2,unit2]),value=>set("unit")(
value==="mm"?void 0:value),{"data-setting":"unit"});this.unitRow=labelled("unit of the lengths",this.unit);this.up=choice("up",AXES.map(axis=>[axis,axis]),value=>set(
"up")(value==="y"?void 0:value),{"data-setting":"up"});this.dimensions=tick("drawings have dimension lines",on=>set("dimensions")(on?void 0:false),{"data-settin\
g":"dimensions"});this.assembled=tick("STL: the parts in their places",on=>set("assembled")(on||void 0),{"data-setting":"assembled"});const rows=(all2,placeholderOf,optionsOf)=>all2.
map(each=>labelled(each[1],number(each[0],placeholderOf(each),optionsOf(each))," "));const sizes=h("details",{class:"bs-section","data-section":"export"},h("sum\
mary",{},"Sizes and settings"),h("p",{class:"bs-hint"},"Left empty: sizes that suit the linkage."),h("div",{class:"bs-grid"},this.unitRow,rows(LENGTHS2,()=>"–",
()=>({kind:"length",above:0})),rows(NUMBERS,each=>each[2],each=>each[3]),labelled("up, in models",this.up)),this.dimensions.element,this.assembled.element);const uses=h(
"div",{class:"bs-uses"}),all=[...formats.map(({format,title,suffix,use})=>({use,title,note:suffix,act:()=>files.export("/export",{format}),data:{"data-export":format}})),
{use:"share",title:"Report",note:".html",act:()=>files.export("/report"),data:{"data-export":"report"}},{use:"share",title:"Result",note:".json",act:()=>files.export(
"/result"),data:{"data-export":"result"}}];const fill=close=>uses.replaceChildren(...Object.entries(USES).map(([use,name])=>[name,all.filter(each=>each.use===use)]).
filter(([,some2])=>some2.length).map(([name,some2])=>h("div",{role:"group","aria-label":name},h("p",{class:"bs-menu-heading"},name),some2.map(each=>menuItem(each,
close)))));this.element=popover("Export",h("div",{class:"bs-menu-list bs-exports"},uses,sizes),fill,{"data-menu":"export"});store.on("document",()=>this.draw());
this.draw()}draw(){const{settings,document:document2}=this.store;for(const[name,field]of this.fields)field.show(settings[name]);give(this.unit,"value",settings.
unit??"mm");give(this.unitRow,"hidden",Boolean(document2.length_unit)&&!settings.unit);give(this.up,"value",settings.up??"y");give(this.dimensions.box,"checked",
settings.dimensions!==false);give(this.assembled.box,"checked",Boolean(settings.assembled))}};var WAY=["x","y","angle","drive","transmission"];var POSE=["x","y","angle_deg","position","turned_deg","transmission_deg"];function decodeFrame(buffer){const length=new DataView(
buffer).getUint32(0,true);const header=JSON.parse(new TextDecoder().decode(new Uint8Array(buffer,4,length)));const numbers=floats(buffer,4+length);for(const linkage of header.
linkages??[]){if(linkage.ways)linkage.ways=linkage.ways.map(way=>({...way,...pieces(numbers,way,WAY)}));if(!linkage.poses)continue;const{count}=linkage.poses;const columns=pieces(
numbers,linkage.poses,POSE);linkage.pose_errors=Array.from({length:count},(_,pose)=>{const at=linkage.at?.[pose]??null;const row={way:at?at[0]:null,frame:at?at[1]:
null};for(const name of POSE){const value=columns[name][pose];row[name]=Number.isNaN(value)?null:value}return row})}return header}function floats(buffer,start){
if(new Uint8Array(new Uint16Array([1]).buffer)[0]===1)return new Float32Array(buffer,start);const view=new DataView(buffer,start);return Float32Array.from({length:view.
byteLength/4},(_,k)=>view.getFloat32(4*k,true))}function pieces(numbers,{start,count},names){return Object.fromEntries(names.map((name,k)=>[name,numbers.subarray(
start+k*count,start+(k+1)*count)]))}var KEYS2=[["Tab","from handle to handle, field to field"],["arrow keys","move what has the focus by a step: a pose, the tip that turns it, a corner, a shape, a\
 number; Shift: ten steps, Alt: a tenth"],["Delete","removes the pose, the corner or the shape"],["Enter","closes an outline; puts a shape in the middle while i\
t is drawn"],["Escape","gives up what is under way: a drag, a drawing, a selection"],["+ − 0","on the plane: zoom and fit; arrow keys pan it"],["space","plays\
 and stops"],["?","this list"],["Ctrl+Z, Ctrl+Shift+Z","undo and redo"],["Ctrl+S, Ctrl+O, Ctrl+V","save the task, open a file, paste rows of a spreadsheet"]];function keyList(){
const close=button("Close",()=>dialog.close());const dialog=h("dialog",{class:"bs-dialog","aria-label":"Keys"},h("h2",{},"Keys"),h("dl",{class:"bs-keys"},KEYS2.
map(([key,what])=>h("div",{},h("dt",{},key),h("dd",{},what)))),close);document.addEventListener("keydown",event=>{if(event.key==="?"&&!written2(event.target)&&!dialog.
open)dialog.showModal()});return[button("?",()=>dialog.showModal(),{"data-do":"keys","aria-label":"Keys",title:"What keys do (?)"}),dialog]}var TYPED_IN="button\
, input, select, textarea, summary, a, [role=button], [role=slider]";var written2=element=>element?.matches?.("input:not([type=checkbox]):not([type=radio]):not(\
[type=range]), textarea");function listenToKeys(store,scene,files=null,root=document){const acts=event=>({z:()=>event.shiftKey?store.redo():store.undo(),y:()=>store.
redo(),...files&&{s:()=>files.save(),o:()=>files.chooser.click()}});root.addEventListener("keydown",event=>{const{key,target}=event,control=(event.ctrlKey||event.
metaKey)&&!event.altKey;if(control){const act2=acts(event)[key.toLowerCase()];if(!act2||written2(target)&&target.dataset.typing==="true"&&/^[zy]$/i.test(key))return;
event.preventDefault();act2()}else if(scene.dragged&&key==="Escape"){event.preventDefault();scene.dragged.cancel()}else if(scene.tool&&!written2(target)&&scene.
tool.key(event)){event.preventDefault();event.stopPropagation()}else if(key==="Escape"&&!written2(target)&&store.selection){store.select(null)}},true);root.addEventListener(
"input",({target})=>target instanceof HTMLElement&&(target.dataset.typing="true"));for(const name of["change","focusout"])root.addEventListener(name,({target})=>target instanceof
HTMLElement&&delete target.dataset.typing)}function listenToSpace({player},root=document){root.addEventListener("keydown",event=>{if(event.key!==" "||event.ctrlKey||
event.metaKey||event.altKey||event.target instanceof Element&&event.target.closest(TYPED_IN)||!player.path)return;event.preventDefault();player.play(!player.playing)})}var POINTS=[12,40];var APART=26;var MEETS=16;var SHARE3=.08;var LEAST_LENGTH=40;var SMOOTHED=9;var OVAL=16;function lineOf({poses,path:path2},view){const points=poses.
filter(({x,y})=>Number.isFinite(x)&&Number.isFinite(y)).map(({x,y})=>`${px(view.X(x))} ${px(view.Y(y))}`);return points.length?`M${points.join("L")}${path2?.closed?
"Z":""}`:""}var PathCurve=class{constructor(store,scene){this.store=store;this.scene=scene;this.line=s("path",{class:"bs-path","aria-hidden":"true"});scene.layer(
"regions").append(this.line);store.on("document",()=>this.draw());scene.on("view",()=>this.draw());this.draw()}draw(){const{store:{document:document2},scene:{view}}=this;
put(this.line,"d",isPath(document2)?lineOf(document2,view):"");put(this.line,"data-path",isPath(document2)?document2.path?.closed?"closed":"open":null)}};function resampled(stroke,{
meets,apart,smooth:smooth2=0}){const gap=Math.hypot(stroke[0][0]-stroke.at(-1)[0],stroke[0][1]-stroke.at(-1)[1]);const size2=Math.hypot(...[0,1].map(k=>Math.max(
...stroke.map(each=>each[k]))-Math.min(...stroke.map(each=>each[k]))));let length=0;for(let k=1;k<stroke.length;k+=1)length+=Math.hypot(stroke[k][0]-stroke[k-1][0],
stroke[k][1]-stroke[k-1][1]);const closed2=gap<Math.max(meets,SHARE3*size2)&&length>3*gap+size2;const line2=closed2?[...stroke,stroke[0]]:stroke,along2=[0];for(let k=1;k<
line2.length;k+=1)along2.push(along2[k-1]+Math.hypot(line2[k][0]-line2[k-1][0],line2[k][1]-line2[k-1][1]));const whole=along2[along2.length-1],count=clamp(Math.
round(whole/apart),POINTS[0],POINTS[1]);const at=wanted=>{const u=closed2?(wanted%whole+whole)%whole:clamp(wanted,0,whole);let k=1;while(k<line2.length-1&&along2[k]<
u)k+=1;const t=along2[k]>along2[k-1]?(u-along2[k-1])/(along2[k]-along2[k-1]):0;return[0,1].map(axis=>line2[k-1][axis]+t*(line2[k][axis]-line2[k-1][axis]))};const near2=(u,k)=>{
const half=closed2?smooth2:Math.min(smooth2,u,whole-u);const parts=[-1,-.5,0,.5,1].map(share=>at(u+share*half));return[0,1].map(axis=>parts.reduce((sum,each)=>sum+
each[axis],0)/parts.length)};return{closed:closed2,points:Array.from({length:count},(_,k)=>near2(whole*k/(closed2?count:count-1),k))}}var PathTool=class{constructor(store,scene,done){
this.store=store;this.scene=scene;this.done=done;this.name="path";this.stroke=null;this.hint="Press, draw the curve that a point of the body is to trace, and le\
t go; where the ends meet it closes. Enter puts an oval in the middle, Escape gives up.";this.line=s("path",{class:"bs-draft bs-draft-path"});scene.layer("tool").
append(this.line)}click(){}drag(point2,held){this.stroke??=[[held.from.X,held.from.Y]];this.stroke.push([point2.X,point2.Y]);put(this.line,"d",`M${this.stroke.map(
each=>each.map(px).join(" ")).join("L")}`);return true}release(){const{stroke}=this;this.stroke=null;put(this.line,"d","");const length=stroke?.slice(1).reduce(
(sum,[x,y],k)=>sum+Math.hypot(x-stroke[k][0],y-stroke[k][1]),0);if(length>LEAST_LENGTH)this.finish(resampled(stroke,{meets:MEETS,apart:APART,smooth:SMOOTHED}))}finish({
points,closed:closed2}){const{store,scene}=this,{view}=scene;const there2=points.map(([X,Y])=>[scene.rounded(view.x(X)),scene.rounded(view.y(Y))]);const{document:document2,
options}=store;if(isPath(document2))store.replace({document:pathDocument(document2,there2,closed2),options});else store.replace({document:pathDocument({length_unit:document2.
length_unit,angle_unit:"deg",poses:[]},there2,closed2),options,name:"path"});store.select(null);scene.use(null);this.done?.(points.length,closed2)}key(event){if(event.
key==="Escape")this.scene.use(null);else if(event.key==="Enter")this.finish(this.oval());else return false;return true}oval(){const{width,height}=this.scene.size,
size2=.2*Math.min(width,height);const points=Array.from({length:OVAL},(_,k)=>2*Math.PI*k/OVAL).map(a=>[width/2+1.5*size2*Math.cos(a),height/2-size2*Math.sin(a)]);
return{points,closed:true}}end(){this.line.remove()}};var PathPanel=class{constructor(store,scene){this.store=store;this.title=h("h3",{});this.closed=tick("closed: the last point leads back to the first",on=>store.
edit(document2=>setPath(document2,{closed:on})),{"data-key":"path-closed"});this.fields=["x","y"].map(key=>({key,field:new NumberField({label:`how far points ma\
y be missed in ${key}`,options:()=>({kind:"length",unit:store.document.length_unit,optional:true,least:0}),step:()=>scene.step/10,commit:value=>store.edit(document2=>setUsual(
document2,key,value)),attributes:{"data-key":`usual-${key}`,placeholder:"–"}})}));this.hint=h("p",{class:"bs-hint"});this.element=h("div",{class:"bs-path-pane\
l","data-details":"path"},this.title,this.closed.element,h("div",{class:"bs-row"},h("span",{class:"bs-label"},"Points may be missed by"),this.fields.map(({key,field})=>labelled(
key,field.element))),this.hint);store.on("document",()=>this.draw());this.draw()}draw(){const{document:document2}=this.store,count=document2.poses.length,path2=isPath(
document2),timed=document2.path?.crank_deg;give(this.element,"hidden",!isOfPoints(document2));if(this.element.hidden)return;say(this.title,path2?`A path of ${count}\
 points${timed?", timed by the crank":""}`:`${count} point${count===1?"":"s"}`);give(this.closed.box,"checked",Boolean(document2.path?.closed));for(const{key,field}of this.
fields)field.show(document2.tolerance?.[key]||void 0);say(this.hint,path2?"Blank: as near as possible, and of what is about as near the one that transmits best.":
"Nine points are met exactly by finitely many linkages, all of which are found; more are a path, which is met as nearly as possible.")}};var BODY_AXIS=AXIS+10;var LETTER2=14;var TURNING_ARROW="M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9";var BLOCK_IN_SLOT=[18,10];var SPARE2=5;var NAME=15;
var ARROW=24;function mechanism(data,linkage,view,places){const drawn=new Mechanism(linkage);drawn.shape(data,linkage,view,places);return drawn}var Mechanism=class{constructor({
led,drawn:links=[],ground,names}){this.kinds=kindsOf(led);this.outline=s("path",{class:"bm-body-outline"});this.links=s("g");this.blocks=s("g");this.pins=s("g");
this.coupler=s("g",{class:"bm-coupler"});this.arrow=s("path",{class:"bm-drive-mark bm-side0"});this.letter=s("text",{class:"bm-letter","text-anchor":"middle"},"\
M");this.plates=[s("path",{class:"bm-plate-rim"}),s("path",{class:"bm-plate"})];this.coupler.append(...this.plates);this.parts=led.map((dyad,side)=>new PARTS[dyad.
kind](this,side));if(links.length)this.parts.push(...links.map(link=>new JointedLink(this,link)),new Joints(this,ground,names));this.coupler.append(s("path",{class:"\
bm-body-frame",d:axes(BODY_AXIS)}),s("circle",{class:"bm-origin",r:4}));for(const part of this.parts)if(part.pin)this.coupler.append(part.pin);this.marks=new LoadMarks;
this.group=s("g",{class:"bm-linkage"},this.arrow,this.links,this.coupler,this.blocks,this.pins,this.marks.group,links.length?null:this.letter)}fits({led}){return kindsOf(
led)===this.kinds}shape(data,linkage,view,places){this.view=view;this.led=linkage.led;this.hasBody=Boolean(data.body);if(this.hasBody){put(this.outline,"d",bodyOutline(
data,view));if(!this.outline.parentNode)this.group.prepend(this.outline)}else{this.outline.remove()}const corners=[[0,0]];linkage.led.forEach((dyad,side)=>{if(dyad.
moving_pivot)corners.push(inBody(dyad.moving_pivot,view));const more=this.parts[side].shape(dyad,view,places);if(more)corners.push(more)});const d=`M${hull(corners).
map(corner=>corner.map(px).join(" ")).join("L")}Z`;for(const plate2 of linkage.drawn?[]:this.plates)put(plate2,"d",d);for(const part of this.parts.slice(linkage.
led.length))part.shape(view);this.marks.shape(data,linkage,view);this.shapeArrow()}show(place,drive=null){const{view}=this,at=transform(view.X(place.x),view.Y(place.
y),place.a);this.marks.show(place,drive);put(this.coupler,"transform",at);if(this.hasBody)put(this.outline,"transform",at);for(const part of this.parts)part.show(
place);const[x,y]=act(place,[LETTER2/view.scale,-LETTER2/view.scale]);put(this.letter,"transform",`translate(${px(view.X(x))} ${px(view.Y(y)+4)})`);const[driver]=this.
led;if(driver.kind==="PR")put(this.arrow,"transform",`${onRail(driver,place,view)} translate(0 ${-ARROW})`)}shapeArrow(){const{arrow:arrow2,view}=this,[driver]=this.
led;if(driver.kind==="PR")put(arrow2,"d","M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5");if(!driver.fixed_pivot)return;const[x,y]=driver.fixed_pivot;put(arrow2,"d",
TURNING_ARROW);put(arrow2,"transform",`translate(${px(view.X(x))} ${px(view.Y(y))}) rotate(-90)`)}};var kindsOf=led=>led.map(dyad=>dyad.kind).join();var inBody=([
x,y],view)=>[view.scale*x,-view.scale*y];function onRail(dyad,place,view){const[x,y]=act(place,dyad.moving_pivot),[nx,ny]=normalOf(dyad);return transform(view.X(
x),view.Y(y),Math.atan2(nx,-ny))}var block=(side,width,height)=>s("g",{class:`bm-block bm-side${side}`},s("rect",{x:-width/2,y:-height/2,width,height,rx:2}));function setPin(pin,[
x,y],dyad){put(pin,"cx",px(x));put(pin,"cy",px(y));put(pin,"data-dyad",dyad.id)}var inGround=([x,y],view)=>[view.X(x),view.Y(y)];var Bar=class{constructor({links,
pins},side){this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"bm-core"})];this.bar=s("g",{class:`bm-link bm-side${side}`},this.strokes);this.ground=s("c\
ircle",{class:"bm-pin bm-fixed-pin",r:4.5});this.pin=s("circle",{class:"bm-pin",r:4.5});links.append(this.bar);pins.append(this.ground)}shape(dyad,view){this.dyad=
dyad;this.view=view;for(const stroke of this.strokes)put(stroke,"d",`M0 0H${px(view.scale*dyad.radius)}`);setPin(this.ground,inGround(dyad.fixed_pivot,view),dyad);
setPin(this.pin,inBody(dyad.moving_pivot,view),dyad)}show(place){const{dyad,view}=this,[cx,cy]=dyad.fixed_pivot,[x,y]=act(place,dyad.moving_pivot);put(this.bar,
"transform",transform(view.X(cx),view.Y(cy),Math.atan2(y-cy,x-cx)))}};var BlockOnRail=class{constructor({blocks},side){this.block=block(side,...BLOCK);this.pin=
s("circle",{class:"bm-pin",r:4.5});blocks.append(this.block)}shape(dyad,view){this.dyad=dyad;this.view=view;put(this.block,"data-dyad",dyad.id);setPin(this.pin,
inBody(dyad.moving_pivot,view),dyad)}show(place){put(this.block,"transform",onRail(this.dyad,place,this.view))}};var Slot=class{constructor({blocks,pins,coupler},side){
this.strokes=["rim","plate","edge"].map(name=>s("path",{class:`bm-slot-${name}`}));this.strokes.push(s("path",{class:"bm-slot"}));this.block=block(side,...BLOCK_IN_SLOT);
this.ground=s("circle",{class:"bm-pin bm-fixed-pin",r:4});coupler.append(...this.strokes);blocks.append(this.block);pins.append(this.ground)}shape(dyad,view,places){
this.dyad=dyad;this.view=view;const[low,high]=places.length?travelOf(dyad,places):[0,0],end=(BLOCK_IN_SLOT[0]/2+SPARE2)/view.scale;const seen2=along2=>inBody(pointOnLine(
dyad,along2),view);const d=`M${[seen2(low-end),seen2(high+end)].map(each=>each.map(px).join(" ")).join("L")}`;for(const stroke of this.strokes)put(stroke,"d",d);
for(const part of[this.strokes[3],this.block])put(part,"data-dyad",dyad.id);setPin(this.ground,inGround(dyad.fixed_pivot,view),dyad);return seen2((low+high)/2)}show(place){
const{dyad,view}=this,[nx,ny]=normalOf(dyad),[cx,cy]=dyad.fixed_pivot;put(this.block,"transform",transform(view.X(cx),view.Y(cy),place.a+Math.atan2(nx,-ny)))}};
var JointedLink=class{constructor({links},{joints,kind}){this.joints=[...joints];this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"bm-core"})];links.append(
s("g",{class:`bm-link bm-${kind}${joints.length>2?" bm-ternary":""}`,"data-link":joints.replace("M","")},this.strokes))}shape(view){this.view=view}show(place){const d=`\
M${this.joints.map(joint=>inGround(place.joints[joint]??[place.x,place.y],this.view).map(px).join(" ")).join("L")}${this.joints.length>2?"Z":""}`;for(const stroke of this.
strokes)put(stroke,"d",d)}};var Joints=class{constructor({pins},ground,names){this.pins=[...Object.keys(ground),...Object.keys(names)].map(joint=>{const pin=s("\
circle",{class:`bm-pin${joint in ground?" bm-fixed-pin":""}`,r:4.5,"data-joint":joint});return{joint,pin,link:[...names[joint]??""],name:joint in ground?null:s(
"text",{class:"bm-name","text-anchor":"middle"},joint)}});pins.append(...this.pins.map(({pin})=>pin),...this.pins.flatMap(({name})=>name??[]))}shape(view){this.
view=view}show({joints}){for(const{joint,pin,link,name}of this.pins){const[x,y]=inGround(joints[joint],this.view);put(pin,"cx",px(x));put(pin,"cy",px(y));if(!name)
continue;const[u,v]=outwards(link.map(each=>inGround(joints[each],this.view)),[x,y]);put(name,"x",px(x+NAME*u));put(name,"y",px(y+NAME*v+4))}}};function outwards(corners,[
x,y]){const middle2=[0,1].map(k=>corners.reduce((sum,corner)=>sum+corner[k],0)/corners.length);const u=x-middle2[0],v=y-middle2[1],size2=Math.hypot(u,v);return size2>
1?[u/size2,v/size2]:[0,-1]}var Nothing=class{shape(){}show(){}};var PARTS={RR:Bar,PR:BlockOnRail,RP:Slot,PP:Nothing,crank:Nothing};var LONGEST_ARM=46;var SHORTEST_ARM=27;var FEW=24;var MOST=240;var ROOM2=14;var NAME2=14;var LONGEST_NAME2=18;var ARROWS2={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[
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
document,k),pose=store.document.poses[k];const selected=store.selection?.kind==="pose"&&store.selection.index===k,unit2=store.document.length_unit??"",name=poseName2(
store.document,k);const point2=isPoint2(pose);if(!isOther(group,[view,this.length,x,y,angle,Boolean(pose.exact),pose.name,name,unit2,selected,point2]))return;const[
arrow2,origin,turn]=group.children;put(group,"transform",transform(view.X(x),view.Y(y),point2?0:radians(angle)));for(const part of[arrow2,turn])put(part,"displa\
y",point2?"none":"inline");group.classList.toggle("bs-point",point2);put(arrow2,"d",axes(this.length-8));put(turn,"transform",`translate(${px(this.length)} 0)`);
group.classList.toggle("bs-selected",selected);group.classList.toggle("bs-exact",Boolean(pose.exact));const what=point2?"Point":"Pose",called=pose.name?`${what}\
 ${k+1}, ${name}`:`${what} ${k+1}`;put(origin,"aria-label",`${called}: x ${x} ${unit2}, y ${y} ${unit2}, ${point2?"angle free":`angle ${angle}°`}. Drag, or use\
 the arrow keys; Delete removes it.`);put(origin,"aria-pressed",selected);put(turn,"aria-label",`Turn ${called}`);put(turn,"aria-valuenow",angle);put(turn,"aria\
-valuetext",`${angle}°`)}obstacles(){const{store,scene:{view},length}=this,boxes=[];for(const k of drawnPoses(store,view.scale)){const{x,y,angle}=standing(store.
document,k),a=radians(angle),[c,d]=[Math.cos(a),Math.sin(a)];const at=(along2,across,size2)=>boxes.push([view.X(x)+along2*c-across*d,view.Y(y)-along2*d-across*c,
size2,size2]);at(0,0,13);if(isPoint2(store.document.poses[k]))continue;at(length,0,12);at(LETTER2,-LETTER2,12);for(const share of[.35,.7])at(share*length,0,6);for(const share of[
.3,.6])at(0,share*(length-8),6)}return boxes}showName(text,k){const{store,scene}=this,{view}=scene,{x,y,angle}=standing(store.document,k),name=shortened(poseName2(
store.document,k),LONGEST_NAME2);if(!isOther(text,[view,x,y,angle,name]))return;say(text,name);scene.names.put(text,view.X(x),view.Y(y),name,around(name,radians(
angle+215),NAME2,scene.names.areMany))}set(k,changes,gesture){this.store.edit(document2=>setPose(document2,k,statedOf(document2.poses[k],changes)),{gesture})}dragOrigin(element,k){
const{store,scene}=this;let gesture,off,before,reach;scene.drag(element,{start:from=>{const{x,y}=standing(store.document,k);gesture=Symbol("move a pose");off=[x-
from.x,y-from.y];before=store.document;reach=isPath(before)?strideOf(before,scene.view.scale):1},move:point2=>reach>1?this.bend(before,k,reach,[point2.x+off[0]-
before.poses[k].x,point2.y+off[1]-before.poses[k].y],gesture):this.set(k,{x:scene.rounded(point2.x+off[0]),y:scene.rounded(point2.y+off[1])},gesture),cancel:()=>store.
abandon(gesture)})}bend({poses,path:path2},k,reach,[dx,dy],gesture){const count=poses.length;const moved=poses.map((pose,j)=>{const away=path2?.closed?Math.min(
Math.abs(j-k),count-Math.abs(j-k)):Math.abs(j-k),share=1-away/reach;return share>0?{...pose,x:this.scene.rounded(pose.x+share*dx),y:this.scene.rounded(pose.y+share*
dy)}:pose});this.store.edit(document2=>({...document2,poses:moved}),{gesture})}dragTurn(element,k){const{store,scene}=this;let gesture,off;const angleTo=point2=>{
const{x,y}=standing(store.document,k);return degrees(Math.atan2(point2.y-y,point2.x-x))};scene.drag(element,{start:from=>{gesture=Symbol("turn a pose");off=standing(
store.document,k).angle-angleTo(from)},move:point2=>this.set(k,{angle:tenths(unwrapped(angleTo(point2)+off,standing(store.document,k).angle))},gesture),cancel:()=>store.
abandon(gesture)})}key(event,k,turning){const{store,scene}=this,arrow2=ARROWS2[event.key];if(event.ctrlKey||event.metaKey)return;if(arrow2){if(!event.repeat)this.
keyed=Symbol("keys");const{x,y,angle}=standing(store.document,k),by=stepOf(event,turning?1:scene.step);if(turning)this.set(k,{angle:stepped(angle,by*(arrow2[0]===
0?arrow2[1]:-arrow2[0]))},this.keyed);else this.set(k,{x:stepped(x,by*arrow2[0]),y:stepped(y,by*arrow2[1])},this.keyed)}else if(event.key==="Delete"||event.key===
"Backspace"){store.edit(document2=>removePose(document2,k));const left=store.document.poses.length;store.select(left?{kind:"pose",index:Math.min(k,left-1)}:null);
this.focus(Math.min(k,left-1))}else{return}event.preventDefault()}focus(k){this.element.querySelector(`[data-pose="${k+1}"]`)?.focus({preventScroll:true})}};var PointTool=class{constructor(store,scene){
this.store=store;this.scene=scene;this.name="point";this.hint="Click where the body's point is to pass; how the body turns there is free. Escape ends."}click({x,
y}){const{store,scene}=this,index=store.document.poses.length;store.edit(document2=>setAngle(addPose(document2,{x:scene.rounded(x),y:scene.rounded(y)}),index,void 0));
store.select({kind:"pose",index})}key(event){if(event.key!=="Escape")return false;this.scene.use(null);return true}};var PoseTool=class{constructor(store,scene){
this.store=store;this.scene=scene;this.name="pose";this.gesture=null;this.hint="Click where the pose is to stand, and click again to turn it. Escape ends."}click(point2){
const{store,scene}=this;if(this.gesture){this.turn(point2);this.gesture=null;return}this.gesture=Symbol("add a pose");const angle=store.document.poses.findLast(
pose=>Number.isFinite(pose.angle))?.angle??0;store.edit(document2=>addPose(document2,{x:scene.rounded(point2.x),y:scene.rounded(point2.y),angle}),{gesture:this.
gesture});store.select({kind:"pose",index:store.document.poses.length-1})}hover(point2){if(this.gesture&&point2)this.turn(point2)}turn(point2){const{store,gesture}=this,
k=store.document.poses.length-1,{x,y,angle}=standing(store.document,k);const away=Math.hypot(point2.x-x,point2.y-y)*this.scene.view.scale;if(away<6)return;const next=tenths(
unwrapped(degrees(Math.atan2(point2.y-y,point2.x-x)),angle));store.edit(document2=>setPose(document2,k,{angle:next}),{gesture})}key(event){if(event.key!=="Escap\
e")return false;if(this.gesture)this.store.abandon(this.gesture);this.gesture=null;this.scene.use(null);return true}};var PAGE=60;var NUMBERS2=[["x","length"],["y","length"],["angle","angle"]];var BOUNDS=[["x","x","length"],["y","y","length"],["angle","angle_deg","angle"]];var oneLine=name=>(name??
"").replace(/[\r\n\u2028\u2029]+/g," ");var PoseTable=class{exact;crank;weight;bounds;crankLine;constructor(store,scene){this.store=store;this.scene=scene;this.
page=0;this.rows=[];this.body=h("tbody",{});this.unit=h("span",{class:"bs-unit"});this.pages=h("div",{class:"bs-pages",hidden:true});this.details=h("div",{class:"\
bs-details","data-details":"pose"});this.hint=h("p",{class:"bs-hint"},"A blank angle is free: then the row is a point, which the body passes at any angle.");this.
table=h("table",{class:"bs-poses","aria-label":"Poses"},h("thead",{},h("tr",{},h("th",{scope:"col"},"#"),h("th",{scope:"col"},"name"),h("th",{scope:"col"},"x"),
h("th",{scope:"col"},"y"),h("th",{scope:"col"},"angle °"))),this.body);const add=button("Add a pose",()=>this.add(),{"data-do":"add-pose-row"});this.element=h(
"div",{class:"bs-table-box"},this.table,this.pages,h("div",{class:"bs-row"},add,this.unit),this.hint,this.details);this.makeDetails();this.pace=new Pace(()=>this.
draw());store.on("document selection",()=>scene.dragged?this.pace.ask():this.draw());scene.on("dropped",()=>this.pace.catchUp());this.draw()}get selected(){const{
selection,document:document2}=this.store;return selection?.kind==="pose"&&selection.index<document2.poses.length?selection.index:null}draw(){const{document:document2}=this.
store,count=document2.poses.length,pages=Math.max(1,Math.ceil(count/PAGE));if(this.selected!==null&&this.selected!==this.shownSelection)this.page=Math.floor(this.
selected/PAGE);this.shownSelection=this.selected;this.page=Math.min(this.page,pages-1);const first=this.page*PAGE,shown2=Math.min(PAGE,count-first);while(this.rows.
length<shown2)this.rows.push(this.makeRow(this.rows.length));while(this.body.children.length>shown2)this.body.lastChild.remove();for(let k=0;k<shown2;k+=1){if(!this.
rows[k].tr.isConnected||this.body.children[k]!==this.rows[k].tr)this.body.append(this.rows[k].tr);this.showRow(this.rows[k],first+k)}say(this.unit,document2.length_unit?
`x and y in ${document2.length_unit}`:"");this.showPages(pages,count);this.showDetails()}makeRow(place){const row={index:place,fields:{}};const change=changes=>this.
store.edit(document2=>setPose(document2,row.index,changes));row.number=h("button",{type:"button",class:"bs-index",onclick:()=>this.store.select(row.index===this.
selected?null:{kind:"pose",index:row.index})});row.name=textField("Name",text=>change({name:text.trim()||void 0}),{class:"bs-text bs-name",placeholder:"–"});const cells2=NUMBERS2.
map(([key,kind])=>{const field=new NumberField({label:key,options:()=>({kind,unit:this.store.document.length_unit,optional:key==="angle"||this.isFree(row.index,
key)}),step:()=>kind==="angle"?1:this.scene.step,commit:value=>key==="angle"?this.store.edit(document2=>setAngle(document2,row.index,value)):change({[key]:value}),
attributes:{"data-key":key}});row.fields[key]=field;return h("td",{},field.element)});row.tr=h("tr",{class:"bs-pose-row"},h("th",{scope:"row"},row.number),h("td",
{},row.name),cells2);row.tr.addEventListener("focusin",event=>event.target!==row.number&&this.store.select({kind:"pose",index:row.index}));return row}isFree(index,key){
return isFree(this.store.document.poses[index],key)}showRow(row,index){const pose=this.store.document.poses[index],moved=row.index!==index,selected=index===this.
selected;row.index=index;if(!isOther(row.tr,[index,pose,selected])&&document.activeElement?.closest("tr")!==row.tr)return;put(row.tr,"data-row",index+1);row.tr.
classList.toggle("bs-selected",selected);say(row.number,index+1);put(row.number,"aria-label",`Pose ${index+1}`);put(row.number,"aria-pressed",selected);if(moved||
document.activeElement!==row.name)give(row.name,"value",oneLine(pose.name));put(row.name,"aria-label",`Name of pose ${index+1}`);for(const[key]of NUMBERS2){const{
input}=row.fields[key],free=this.isFree(index,key);put(input,"aria-label",`${key} of pose ${index+1}`);put(input,"placeholder",free?"free":"");row.fields[key].turnTo(
index,pose[key]);row.fields[key].show(pose[key])}}showPages(pages,count){give(this.pages,"hidden",pages<2);if(pages<2)return;const go=page=>{this.page=page;this.
draw()};this.pages.replaceChildren(button("‹",()=>go(Math.max(0,this.page-1)),{"aria-label":"Earlier poses",disabled:this.page===0}),h("span",{},`${this.page*
PAGE+1}–${Math.min(count,(this.page+1)*PAGE)} of ${count}`),button("›",()=>go(Math.min(pages-1,this.page+1)),{"aria-label":"Later poses",disabled:this.page===
pages-1}))}add(){const{store,scene}=this,count=store.document.poses.length;const last=count?standing(store.document,count-1):{x:0,y:0,angle:0},ofPoints=isOfPoints(
store.document);store.edit(document2=>{const more=addPose(document2,count?{...last,x:scene.rounded(last.x+10*scene.step)}:last);return ofPoints?setAngle(more,count,
void 0):more});store.select({kind:"pose",index:count});const field=this.rows.find(row=>row.index===count&&row.tr.isConnected)?.fields.x.input;field?.focus();field?.
select()}makeDetails(){const{store}=this;const at=()=>this.selected;const edit=change=>store.edit(document2=>change(document2,at()));this.title=h("h3",{class:"b\
s-pose-title"});this.exact=tick("met exactly",on=>edit((document2,k)=>setPose(document2,k,{exact:on||void 0})),{"data-key":"exact"});this.weight=new NumberField(
{label:"weight",options:()=>({optional:true,above:0}),commit:value=>edit((document2,k)=>setPose(document2,k,{weight:value})),attributes:{"data-key":"weight",placeholder:"\
1"}});this.bounds=BOUNDS.map(([component2,key,kind])=>{const field=new NumberField({label:`tolerance of ${component2}`,options:()=>({kind,unit:store.document.length_unit,
optional:true,least:0}),step:()=>kind==="angle"?1:this.scene.step,commit:value=>edit((document2,k)=>setTolerance(document2,k,key,value)),attributes:{"data-key":`\
tolerance-${component2}`,placeholder:"–"}});const turned=(document2,k,on)=>setAngle(document2,k,on?void 0:standing(document2,k).angle);const free=tick("free",
on=>edit((document2,k)=>component2==="angle"?turned(document2,k,on):setFree(document2,k,component2,on)),{"data-key":`free-${component2}`,"aria-label":`${component2}\
 is free`});return{component:component2,key,field,free}});this.axes=choice("Axes of the tolerance",[["fixed","along the axes of the ground"],["body","along the \
axes of the body"]],value=>edit((document2,k)=>setTolerance(document2,k,"axes",value==="body"?value:void 0)),{"data-key":"tolerance-axes"});const act2=(text,name,change,then)=>button(
text,()=>{const k=at();edit(change);store.select(then(k)===null?null:{kind:"pose",index:then(k)})},{"data-do":name});const last=()=>store.document.poses.length-
1;this.up=act2("Earlier","earlier",(document2,k)=>movePose(document2,k,k-1),k=>k-1);this.down=act2("Later","later",(document2,k)=>movePose(document2,k,k+1),k=>k+
1);this.crank=new NumberField({label:"crank angle",options:()=>({kind:"angle"}),step:()=>1,commit:value=>edit((document2,k)=>setCrank(document2,k,value)),attributes:{
"data-key":"crank"}});this.crankLine=labelled("crank angle °",this.crank.element);this.details.append(this.title,this.crankLine,h("div",{class:"bs-row"},this.exact.
element,labelled("weight",this.weight.element)),h("p",{class:"bs-hint"},"Tolerance: how far from it the body may be, to either side"),h("table",{class:"bs-toler\
ances","aria-label":"Tolerance"},h("tbody",{},this.bounds.map(({component:component2,field,free})=>h("tr",{},h("th",{scope:"row"},component2==="angle"?"angle °":
component2),h("td",{},field.element),h("td",{},free.element))))),this.axes,h("div",{class:"bs-row"},this.up,this.down,act2("Duplicate","duplicate",duplicatePose,
k=>k+1),act2("Delete","delete-pose",removePose,k=>last()<0?null:Math.min(k,last()))))}showDetails(){const k=this.selected;give(this.details,"hidden",k===null);if(k===
null)return;const{poses}=this.store.document,pose=poses[k];if(!isOther(this.details,[k,pose,poses.length,this.store.document.path])&&!this.details.contains(document.
activeElement))return;const turned=this.store.document.path?.crank_deg?.[k];give(this.crankLine,"hidden",turned===void 0);this.crank.turnTo(k,turned);this.crank.
show(turned);this.title.replaceChildren(`${isPoint2(pose)?"Point":"Pose"} ${k+1}`,...pose.name?[": ",h("bdi",{},oneLine(pose.name))]:[]);give(this.exact.box,"ch\
ecked",Boolean(pose.exact));this.weight.turnTo(k,pose.weight);this.weight.show(pose.weight);for(const{component:component2,key,field,free}of this.bounds){const isFree2=this.
isFree(k,component2)||pose.tolerance?.[component2]==="free";give(free.box,"checked",isFree2);give(field.input,"disabled",isFree2);const stated=pose.tolerance?.[key],
bound=typeof stated==="number"?stated:void 0;field.turnTo(k,bound);field.show(bound)}give(this.axes,"hidden",!pose.tolerance);give(this.axes,"value",pose.tolerance?.
axes??"fixed");give(this.up,"disabled",k===0);give(this.down,"disabled",k===poses.length-1)}};var LONGEST_NAME3=22;var ABOVE=10;var HATCH2=9;var PIVOT2={fixed_pivot:"Fixed pivot",moving_pivot:"Moving pivot"};function limitName(document2,{table:table3,key}){
return`${PIVOT2[key]}${limitsOf(document2).length>1?` of dyad ${table3+1}`:""}`}function regionShape(region){if(region.box)return{shape:"box",points:region.box};
return region.polygon?{shape:"polygon",points:region.polygon}:null}var Regions=class{onjudged;constructor(store,scene){this.store=store;this.scene=scene;this.shapes=
new Map;scene.layer("regions").append(s("defs",{},s("pattern",{id:"bs-hatch",width:HATCH2,height:HATCH2,patternUnits:"userSpaceOnUse",patternTransform:"rotate(4\
5)"},s("path",{class:"bm-hatch",d:`M0 0V${HATCH2}`}))));this.regions=new Kept(s("g"),(key,k)=>this.makeRegion(k),element=>this.shapes.get(element).draw());this.
footprint=new Kept(s("g"),()=>this.makeFootprint(),element=>this.shapes.get(element).draw());this.limits=new Kept(s("g"),(key,limit)=>this.makeLimit(limit),element=>this.
shapes.get(element).draw());this.names=new Kept(s("g",{class:"bs-region-names","aria-hidden":"true"}),()=>s("text",{}),(text,name)=>this.showName(text,name));scene.
layer("regions").append(this.regions.group,this.footprint.group);scene.layer("limits").append(this.limits.group);scene.layer("labels").append(this.names.group);
store.on("document",()=>this.judge(store.state==="dragging"&&!this.isOther()));store.on("selection",()=>this.draw());store.on("solved followed chosen placed",()=>this.
judge());scene.on("view",()=>this.draw());scene.hold(()=>limitRegions(store.document).filter(({shape})=>shape!=="line").flatMap(each=>this.corners(each)));scene.
hold(()=>regionsOf(store.document).map(regionShape).filter(Boolean).flatMap(({shape,points})=>outlineOf(shape,points)),true);this.judge()}place({key}){return key===
"moving_pivot"?referencePlace(this.store):GROUND}corners(limit){return outlineOf(limit.shape,limit.points).map(point2=>act(this.place(limit),point2))}isOther(){
const{body,keep_out,surroundings}=this.store.document,now=[body,keep_out,surroundings];return now.some((each,k)=>each!==this.judged?.[k])}judge(pivots=false){const{
document:document2,solved}=this.store,linkage=currentLinkage(this.store);this.broken=linkage?.led?limitsMissed(document2,linkage,solved?.scene??1):null;if(!pivots){
this.judged=[document2.body,document2.keep_out,document2.surroundings];this.touched=linkage?.led?regionsTouched(document2,linkage,bodyOf(document2)):null}this.draw();
this.onjudged?.()}said(table3,key){return this.broken?.[table3]?.filter(each=>each.key===key).map(each=>missedSentence(each,this.store.document.length_unit))??null}draw(){
const{document:document2}=this.store,regions=regionsOf(document2),limits=limitRegions(document2),{footprint}=document2.requirements??{};this.regions.draw(regions.
map((region,k)=>[k,k]).filter(([k])=>regionShape(regions[k])));this.limits.draw(limits.map(limit=>[`${limit.table} ${limit.key}`,limit]));this.footprint.draw(footprint?
[["footprint",footprint]]:[]);for(const[element,handles]of this.shapes){if(element.parentNode)continue;handles.clear();this.shapes.delete(element)}this.names.draw(
[...regions.map((region,k)=>[`region ${k}`,region.name&&regionShape(region)?{text:region.name,at:middle(outlineOf(...Object.values(regionShape(region))))}:null]),
...limits.map(limit=>[`limit ${limit.table} ${limit.key}`,{text:limitName(document2,limit),at:middleOf(this.corners(limit),limit.key==="moving_pivot"),off:limit.
key==="moving_pivot"?ABOVE:-ABOVE,width:widthOf(this.corners(limit))}]),["footprint",footprint?{text:"Footprint",at:middleOf(footprint.polygon??outlineOf("box",
footprint.box),true),off:ABOVE,width:widthOf(footprint.polygon??footprint.box)}:null]].filter(([,name])=>name))}kept(handles){this.shapes.set(handles.element,handles);
return handles.element}makeRegion(k){const{store}=this;const handles=new ShapeHandles(this.scene,{className:"bs-region",what:()=>{const region=regionsOf(store.document)[k];
return{...regionShape(region),place:GROUND,name:region.name?`Keep out: ${region.name}`:`Region ${k+1} to keep out of`,selected:store.selection?.kind==="region"&&
store.selection.index===k,state:this.touched?this.touched[k]?"broken":"met":"",data:{region:k}}},set:(points,gesture)=>store.edit(document2=>setRegion(document2,
k,shapeOf(regionShape(regionsOf(document2)[k]).shape,points)),{gesture}),remove:()=>this.removeRegion(k),select:()=>store.select({kind:"region",index:k}),abandon:gesture=>store.
abandon(gesture)});handles.element.insertBefore(s("path",{class:"bs-hatched",fill:"url(#bs-hatch)"}),handles.area);const draw=handles.draw.bind(handles);handles.
draw=()=>{draw();handles.element.querySelector(".bs-hatched").setAttribute("d",handles.line.getAttribute("d"))};return this.kept(handles)}removeRegion(k){this.store.
edit(document2=>removeRegion(document2,k));this.store.select(null);this.scene.svg.focus({preventScroll:true})}makeLimit({table:table3,key}){const{store}=this,place=()=>this.
place({key});const at=()=>limitRegions(store.document).findIndex(each=>each.table===table3&&each.key===key);return this.kept(new ShapeHandles(this.scene,{className:`\
bs-limit bs-${key.replace("_","-")}`,what:()=>{const index=at(),limit=limitRegions(store.document)[index],said=this.said(table3,key);return{...limit,place:place(),
name:`Limit: ${limitName(store.document,limit)}`,selected:store.selection?.kind==="limit"&&store.selection.index===index,state:said?said.length?"broken":"met":"",
data:{limit:index,plane:key==="moving_pivot"?"M":"F"}}},set:(points,gesture)=>store.edit(document2=>setLimit(document2,table3,{[key]:shapeOf(Object.keys(limitsOf(
document2)[table3][key])[0],points)}),{gesture}),remove:()=>this.removeLimit(table3,key),select:()=>store.select({kind:"limit",index:at()}),abandon:gesture=>store.
abandon(gesture)}))}removeLimit(table3,key){this.store.edit(document2=>setLimit(document2,table3,{[key]:void 0}));this.store.select(null);this.scene.svg.focus({
preventScroll:true})}makeFootprint(){const{store}=this,shape=()=>Object.keys(store.document.requirements.footprint)[0];return this.kept(new ShapeHandles(this.scene,
{className:"bs-footprint",what:()=>({shape:shape(),points:store.document.requirements.footprint[shape()],place:GROUND,name:"Footprint: holds all pivots",selected:store.
selection?.kind==="footprint",data:{footprint:""}}),set:(points,gesture)=>store.edit(document2=>setRequirement(document2,"footprint",{[shape()]:points}),{gesture}),
remove:()=>{store.edit(document2=>setRequirement(document2,"footprint",void 0));store.select(null)},select:()=>store.select({kind:"footprint",index:0}),abandon:gesture=>store.
abandon(gesture)}))}showName(text,{text:name,at:[x,y],off,width}){const{scene}=this,{view}=scene,shown2=shortened(name,LONGEST_NAME3);say(text,shown2);put(text,
"class",off?"bs-limit-name":"bs-region-name");scene.names.put(text,view.X(x),view.Y(y),shown2,off?along(off,view.scale*(width??0)):[[0,0,0]])}regionTool(shape){
const{store}=this;return new ShapeTool(this.scene,{shape,name:`region ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>addRegion(document2,{[shape]:points}));
store.select({kind:"region",index:regionsOf(store.document).length-1})}})}limitTool(table3,key,shape){const{store}=this;return new ShapeTool(this.scene,{shape,name:`\
limit ${table3} ${key} ${shape}`,place:()=>this.place({key}),done:points=>{store.edit(document2=>setLimit(document2,table3,{[key]:shapeOf(shape,points)}));store.
select({kind:"limit",index:limitRegions(store.document).findIndex(each=>each.table===table3&&each.key===key)})}})}footprintTool(shape){const{store}=this;return new ShapeTool(
this.scene,{shape,name:`footprint ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>setRequirement(document2,"footprint",{[shape]:points}));store.select(
{kind:"footprint",index:0})}})}};function middle(points){const[x,y,u,v]=bounds(points);return[(x+u)/2,(y+v)/2]}function middleOf(points,upper){const[x,y,u,v]=bounds(
points);return[(x+u)/2,upper?v:y]}function widthOf(points){const[x,,u]=bounds(points);return Number.isFinite(u-x)?u-x:0}function unfoldForPrint(root,signal){window.addEventListener("beforeprint",()=>{for(const part of detailsOf(root,":not([open])")){part.open=true;part.dataset.opened=
""}},{signal});window.addEventListener("afterprint",()=>{for(const part of detailsOf(root,"[data-opened]")){part.open=false;delete part.dataset.opened}},{signal})}
var detailsOf=(root,which)=>root.querySelectorAll(`details${which}`);var Events=class{heard;on(names,fn){this.heard??=new Map;for(const name of names.split(" "))this.heard.set(name,[...this.heard.get(name)??[],fn])}emit(name,...values){
for(const fn of this.heard?.get(name)??[])fn(...values)}};var LONGEST_NAME4=5;var FOLLOWED=1e-7;var EXACT_TURN=1e-5;var UNSEEN=1e-6;var PLACED="placed";var NOTHING={poses:[],body:null,keep_out:[],loads:null,scene:1,unit:null,
dyads:[],linkages:[],dyads_title:"Dyads",chart:{origin:[0,0],angle:0,length:1},space:{centre:[0,0,0],half:[1,1,1],quadrics:[]},pivot_map:null,family_map:null,transmission_limit:{
deg:40,said:"40°, a usual limit"},keys:[],table:null,best:[],warnings:[],footnotes:""};var Answers=class extends Events{constructor(store){super();this.store=store;
this.data={...NOTHING};this.linkages=[];this.gone=[];this.byId=new Map;this.placed=null;store.on("solved",()=>this.takeSolved());store.on("followed",()=>this.takeFollowed());
store.on("document",()=>this.takePoses());store.on("chosen",()=>this.emit("shown"));store.on("placed",()=>this.takePlaced());this.takePoses();if(store.solved)this.
takeSolved()}get shown(){return this.get(this.store.chosen)??(this.store.chosen===PLACED?void 0:this.linkages[0])}get(id){return id===PLACED?this.placed??void 0:
this.byId.get(id)}get isOld(){return this.store.solvedFor!==this.store.document}takePoses(){const poses=posesOf(this.store.document);Object.assign(this.data,{poses,
isPath:isPath(this.store.document),...surroundingsOf(this.store.document,this.data)});this.emit("poses")}takeSolved(){const{solved,document:document2}=this.store,
before=this.linkages.filter(each=>!each.gone);const{renamed:names,moved}=this.store;const was=new Map([...names].map(([old,id])=>[id,this.byId.get(old)]));const{
poses,body,keep_out,...rest}=solved;Object.assign(this.data,{body,keep_out,...rest,poses:posesOf(document2)});this.gone=this.store.isEmpty||this.store.isAnother?
[]:before.filter(each=>!names.has(each.id)).map(each=>each.id);this.byId=new Map;this.linkages=solved.linkages.map(fresh=>{const kept2=was.get(fresh.id),now=kept2??
{};const stood=kept2&&kept2.rank!==Infinity;const before2=stood&&kept2.id!==fresh.id?kept2.id:null;for(const key of Object.keys(now))delete now[key];Object.assign(
now,figured(linked(fresh)),{was:before2,shift:moved.get(fresh.id)??0,isNew:this.known&&!this.store.isAnother&&!stood,followed:false,gone:null,change:null});this.
byId.set(now.id,now);return now});this.known=!this.store.isEmpty;this.emit("answers")}takeFollowed(){const frame=this.store.followed;if(!frame)return;for(const each of frame.
linkages){let now=this.byId.get(each.id);if(now&&each.fresh===false)continue;if(!now){now=appeared(each);this.byId.set(each.id,now);this.linkages.push(now);this.
hasNew=true}follow(now,each,this.data)}for(const{id,message}of frame.vanished??[]){const now=this.byId.get(id);if(now)Object.assign(now,{gone:message,usable:false})}
for(const{id,kind,message}of frame.changes??[]){const now=this.byId.get(id);if(now&&kind!=="vanished")now.change=message}if(this.hasNew){this.hasNew=false;this.
emit("answers")}else{this.emit("moved")}}takePlaced(){const placed=this.store.placed?.linkage,{cognateOf}=this.store.placed??{},called=cognateOf?`Cognate of ${cognateOf}`:
"By hand";const before=this.placed;this.placed=placed?Object.assign(before??{},figured(linked(placed)),{id:PLACED,called,gone:null,followed:false}):null;this.emit(
"placed");if(this.store.chosen===PLACED)this.emit(before&&placed?"moved":"shown")}};var linked=linkage=>({...linkage,pose_errors:linkage.pose_errors.map(row=>({
...row,at:row.way===null?null:linkage.ways[row.way]}))});var figured=linkage=>Object.assign(linkage,{worst:linkage.position_error.max,least:linkage.min_transmission_angle_deg.
range});function posesOf({poses=[]}){const names=poses.map((pose,k)=>pose.name||String(k+1));const short=names.every(name=>name.length<=LONGEST_NAME4);return poses.
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
10*linkage.least+1e-6)/10}°`}function dimensionsOf(linkage,data){const digits=decimalsOf(data),point2=p=>`(${p.map(value=>fixed(value,digits)).join(", ")})`;return linkage.
led.flatMap(dyad=>[...dyad.fixed_pivot?[{dyad:dyad.id,what:"fixed pivot in F",value:point2(dyad.fixed_pivot)}]:[],...dyad.moving_pivot?[{dyad:dyad.id,what:"movi\
ng pivot in M",value:point2(dyad.moving_pivot)}]:[],...dyad.radius!==void 0?[{dyad:dyad.id,what:"length",value:fixed(dyad.radius,digits)}]:[],...dyad.line?[{dyad:dyad.
id,what:`line in ${dyad.kind==="PR"?"F":"M"}, normal and offset`,value:`${fixed(dyad.line.normal_deg,2)}°, ${fixed(dyad.line.offset,digits)}`}]:[]])}var placeOf=row=>({
x:row.x,y:row.y,a:radians(row.angle_deg)});var dot=(a,b)=>a[0]*b[0]+a[1]*b[1]+a[2]*b[2];var scaled=(a,k)=>[a[0]*k,a[1]*k,a[2]*k];var plus=(a,b)=>[a[0]+b[0],a[1]+b[1],a[2]+b[2]];var cross2=(a,b)=>[a[1]*b[2]-
a[2]*b[1],a[2]*b[0]-a[0]*b[2],a[0]*b[1]-a[1]*b[0]];var unit=a=>scaled(a,1/Math.hypot(...a));var times=(c,p,w)=>[0,4,8,12].map(r=>c[r]*p[0]+c[r+1]*p[1]+c[r+2]*p[2]+
c[r+3]*w);function intersections(c,o,d){const cd=times(c,d,0),co=times(c,o,1);const a=dot(d,cd),b=dot(o,cd)+cd[3],e=dot(o,co)+co[3];const root=b*b-a*e;if(root<0)
return[];const q=-(b+(b<0?-1:1)*Math.sqrt(root));const roots=[];if(Math.abs(a)>1e-12*Math.abs(q))roots.push(q/a);if(q!==0)roots.push(e/q);return roots}function instantCentre(dyads,place){const[u,v,omega]=cross2(gradient(dyads[0],place),gradient(dyads[1],place));const centre=[place.x-v/omega,place.y+u/omega];return Number.
isFinite(centre[0])&&Number.isFinite(centre[1])?centre:null}function centrodePoint(dyads,place){const fixed2=instantCentre(dyads,place);return fixed2&&{fixed:fixed2,
moving:back(place,fixed2)}}function driveOf(dyad,place){if(dyad.kind==="PR")return alongLine(dyad,place);if(dyad.kind==="RP")return place.a+radians(dyad.line.normal_deg);
const[x,y]=act(place,dyad.moving_pivot);return Math.atan2(y-dyad.fixed_pivot[1],x-dyad.fixed_pivot[0])}function transmissionOf(driver,follower,place){if(driver.
kind==="PP"||follower.kind==="PP")return null;const slot=dyad=>{const[nx,ny]=normalOf(dyad),c=Math.cos(place.a),d=Math.sin(place.a);return[c*nx-d*ny,d*nx+c*ny]};
if(driver.kind==="RP"&&follower.kind==="RP")return 90;if(follower.kind==="RP"){const pin=act(place,driver.moving_pivot),[x,y]=follower.fixed_pivot;return between(
slot(follower),[x-pin[0],y-pin[1]])}const end=act(place,follower.moving_pivot);const lever=follower.kind==="PR"?normalOf(follower):[end[0]-follower.fixed_pivot[0],
end[1]-follower.fixed_pivot[1]];if(driver.kind==="RP")return between(slot(driver),lever);const start=act(place,driver.moving_pivot);return between([end[0]-start[0],
end[1]-start[1]],lever)}var between=(a,b)=>Math.atan2(Math.abs(a[0]*b[1]-a[1]*b[0]),Math.abs(a[0]*b[0]+a[1]*b[1]))*180/Math.PI;var Labels=class{constructor(view){this.view=view;this.taken=[]}block(x,y,width,height){this.taken.push([x-width/2,y-height/2,x+width/2,y+height/2])}put(x,y,text,distance,attributes){
const width=7.2*text.length+4,height=14;let best={cost:Infinity,cx:0,cy:0,box:[0,0,0,0]};for(let ring=0;ring<3;ring+=1){for(let k=0;k<16;k+=1){const angle=Math.
PI/8*k+Math.PI/4;const away=distance+9*ring;const cx=x+(away+width/2-6)*Math.cos(angle);const cy=y-away*Math.sin(angle);const box=[cx-width/2,cy-height/2,cx+width/
2,cy+height/2];let cost=.02*k+6*ring;for(const other of this.taken){const across=Math.min(box[2],other[2])-Math.max(box[0],other[0]);const down=Math.min(box[3],
other[3])-Math.max(box[1],other[1]);if(across>0&&down>0)cost+=across*down}if(box[0]<2||box[2]>this.view.width-2)cost+=500;if(box[1]<2||box[3]>this.view.height-2)
cost+=500;if(cost<best.cost)best={cost,cx,cy,box}}}this.taken.push(best.box);return s("text",{x:px(best.cx),y:px(best.cy+4),"text-anchor":"middle",...attributes},
text)}};var LONGEST=4e3;function railOf(dyad,places,view){const[nx,ny]=normalOf(dyad),[low,high]=travelOf(dyad,places);const half=view.scale*(high-low)/2+BLOCK[0],edge=BLOCK[1]/
2+1;const[x,y]=(at=>[view.X(at[0]),view.Y(at[1])])(pointOnLine(dyad,(low+high)/2));const bodySide=places.reduce((sum,place)=>sum+nx*place.x+ny*place.y-dyad.line.
offset,0);const turned=Math.atan2(nx,-ny)+(bodySide>0?Math.PI:0);const drawn=Math.min(half,LONGEST);let hatch="";for(let k=-drawn+4;k<drawn-2;k+=8)hatch+=`M${px(
k+4)} ${edge}l-6 7`;return{x,y,half,drawn,turned,paths:[`M${px(-half)} ${edge}H${px(half)}${hatch}`,`M${px(-half)} ${-edge}H${px(half)}`]}}var CLOSER=.4;var BESIDE_PIVOT=[16,28,40];var FACTORS=[0,1,10,100,1e3,1e4,1e5];function factorFor(data,linkage){const worst=Math.max(0,...linkage.pose_errors.map(
row=>row.position??0));if(!(worst>1e-9*data.scene))return 0;const fits=FACTORS.filter(factor=>factor>=1&&factor*worst<.3*data.scene);return fits.length?fits[fits.
length-1]:1}var sizeOf=([x,y,u,v])=>Math.max(u-x,v-y);var standing2=(dyad,places)=>dyad.fixed_pivot??(dyad.kind==="PR"&&places.length?pointOnLine(dyad,travelOf(
dyad,places).reduce((a,b)=>(a+b)/2)):null);var Plane=class{view;places;linkage;reveal;constructor(data,parent){this.data=data;this.svg=s("svg",{class:"bm-plane",role:"img",tabindex:"0"});this.parent=parent;
parent.append(this.svg)}build(linkage,way,stretch,{factor,fill,far,close=false}){const{data,svg}=this,path2=linkage?.ways[way];this.linkage=linkage;this.way=way;
this.places=path2?placesOf(data,linkage,path2,stretch):[];const width=Math.max(260,this.parent.clientWidth);const box=boxOf(data,linkage,this.places,{whole:far,
close}),different=other=>other.some((each,k)=>each!==box[k]);this.cut=!far&&different(boxOf(data,linkage,this.places,{whole:true}));this.isLarge=close||Boolean(
linkage)&&sizeOf(boxOf(data,linkage,this.places,{close:true}))<CLOSER*sizeOf(box);const shape=(box[3]-box[1])/(box[2]-box[0]);const own=clamp(width*clamp(shape,
.45,1),260,clamp(.62*window.innerHeight,340,680));const height=Math.round(fill?clamp(fill,own,1.15*width):own);const view=viewOf(box,width,height,width<500?34:42);
this.view=view;svg.setAttribute("viewBox",`0 0 ${width} ${height}`);svg.setAttribute("height",height);svg.dataset.scale=view.scale;svg.dataset.left=view.left;svg.
dataset.top=view.top;svg.replaceChildren();svg.append(this.grid(),keepOut(data,view),ghosts(data,linkage,view));svg.append(...[this.wantedPath(),linkage?this.paths():
null].filter(Boolean));const labels=new Labels(view);this.names=s("g",{class:"bm-names"},keepOutNames(data,view,labels));if(linkage)svg.append(this.ground(labels));
for(const pose of data.poses){const x=view.X(pose.x),y=view.Y(pose.y),angle=radians(pose.angle_deg);const c=AXIS*Math.cos(angle),d=AXIS*Math.sin(angle);labels.block(
x,y,12,12);if(isPoint(pose))continue;for(const share of[.35,.65,1]){labels.block(x+share*c,y-share*d,6,6);labels.block(x-.6*share*d,y-.6*share*c,6,6)}}svg.append(
this.poses(linkage,factor,labels));this.moving=path2?mechanism(data,linkage,view,this.places):null;if(this.moving)svg.append(this.moving.group);if(linkage)this.
farPivots(labels);svg.append(this.names)}grid(){const{view}=this,group=s("g",{class:"bm-grid","aria-hidden":"true"});const unit2=this.data.unit?` ${this.data.unit}`:
"";const across=ticks(-view.left/view.scale,(view.width-view.left)/view.scale,view.width/110);const up=ticks((view.top-view.height)/view.scale,view.top/view.scale,
view.height/80);for(const{at,text}of across){const x=px(view.X(at));group.append(s("path",{d:`M${x} 0V${view.height}`}));if(x>46&&x<view.width-(unit2?54:30)){group.
append(s("text",{x,y:view.height-6,"text-anchor":"middle"},text))}}for(const{at,text}of up){const y=px(view.Y(at));group.append(s("path",{d:`M0 ${y}H${view.width}`}));
if(y>26&&y<view.height-24)group.append(s("text",{x:6,y:y-4},text))}group.append(s("text",{x:6,y:14},`y${unit2}`),s("text",{x:view.width-6,y:view.height-6,"text-\
anchor":"end"},`x${unit2}`));return group}paths(){const{view,linkage,places}=this,group=s("g",{class:"bm-paths"});linkage.ways.forEach((way,k)=>{const same=way.
circuit===linkage.ways[this.way]?.circuit;const kind=k===this.way?"bm-beyond":same?"bm-same":"bm-other";const whole=placesOf(this.data,linkage,way,{low:0,high:way.
x.length-1});const d2=polyline(whole.map(({x,y})=>[x,y]),view);group.append(s("path",{class:`bm-curve ${kind}`,d:d2}))});for(const{side,points}of this.pivotPaths()){
group.append(s("path",{class:`bm-pivot-path bm-side${side}`,d:polyline(points,view)}))}const d=polyline(places.map(({x,y})=>[x,y]),view);group.append(s("path",{
class:"bm-curve bm-here",d}));return group}pivotPaths(){const{places,linkage}=this;if(linkage.traced)return[...linkage.traced].map(joint=>({side:"-inner",points:places.
map(place=>place.joints[joint])}));const drawn=[...linkage.led.entries()].filter(([,dyad])=>dyad.moving_pivot&&dyad.kind!=="PR");return drawn.map(([side,dyad])=>({
side,points:places.map(place=>act(place,dyad.moving_pivot))}))}ground(labels){const group=s("g",{class:"bm-grounds"});this.keepCranksFree(labels);this.linkage.led.
forEach((dyad,k)=>{const side=Math.min(k,1);if(dyad.kind==="PR")this.rail(group,labels,dyad,side);else if(dyad.fixed_pivot)this.fixedPivot(group,labels,dyad,side)});
return group}keepCranksFree(labels){const{view,places,linkage}=this,every=Math.ceil(places.length/9);const arms=(linkage.drawn??[]).flatMap(({joints})=>[...joints].
filter(joint=>joint in linkage.ground).flatMap(pivot=>[...joints].map(end=>[pivot,end])));for(const{joints}of places.filter((_,k)=>k%every===0)){for(const[pivot,
end]of arms){const[[x,y],[u,v]]=[joints[pivot],joints[end]].map(at=>[view.X(at[0]),view.Y(at[1])]),size2=Math.hypot(u-x,v-y);if(size2)for(const along2 of BESIDE_PIVOT)
labels.block(x+along2*(u-x)/size2,y+along2*(v-y)/size2,12,12)}}}rail(group,labels,dyad,side){if(!this.places.length)return;const{x,y,drawn,turned,paths}=railOf(
dyad,this.places,this.view),[nx,ny]=normalOf(dyad);group.append(s("g",{class:`bm-rail bm-side${side}`,"data-dyad":dyad.id,transform:transform(x,y,turned)},s("pa\
th",{class:"bm-ground",d:paths[0]}),s("path",{class:"bm-ground bm-thin",d:paths[1]})));for(let k=-drawn;k<=drawn;k+=14)labels.block(x-k*ny,y-k*nx,22,22);this.names.
append(labels.put(x,y,dyad.id,26,{class:`bm-name bm-side${side}`}))}fixedPivot(group,labels,dyad,side){const x=this.view.X(dyad.fixed_pivot[0]),y=this.view.Y(dyad.
fixed_pivot[1]);labels.block(x,y+10,32,34);if(!side)labels.block(x,y,40,40);const at=foot();at.setAttribute("transform",`translate(${px(x)} ${px(y)})`);group.append(
at);this.names.append(labels.put(x,y+4,dyad.name??dyad.id,27,{class:`bm-name bm-side${side}`}))}farPivots(labels){const{data,view}=this,digits=decimalsOf(data);
this.linkage.led.forEach((dyad,side)=>{const at=standing2(dyad,this.places);const edge=at&&edgeTowards(view,at);if(!edge)return;const text=`${dyad.name??dyad.id}\
: ${dyad.fixed_pivot?"fixed pivot":"rail"} at (${at.map(each=>fixed(each,digits)).join(", ")})`;labels.block(edge.x,edge.y,20,20);this.names.append(s("g",{class:"\
bm-to-far",onclick:()=>this.reveal?.()},s("path",{class:`bm-far-mark bm-side${side}`,d:"M-9 -6L3 0L-9 6",transform:transform(edge.x,edge.y,edge.angle)}),labels.
put(edge.x,edge.y,text,14,{class:`bm-name bm-far-name bm-side${side}`})))})}wantedPath(){const{data,view}=this;if(!data.path)return null;const points=data.poses.
map(({x,y})=>[x,y]);return s("path",{class:"bm-wanted-path",d:`${polyline(points,view)}${data.path.closed?"Z":""}`})}poses(linkage,factor,labels){const{data,view}=this,
group=s("g",{class:"bm-poses"});const small=data.poses.length>24?.6:1;const arrows=this.errors(linkage,factor,labels);const names=s("g",{class:"bm-pose-names"});
data.poses.forEach((pose,k)=>{const x=view.X(pose.x),y=view.Y(pose.y);group.append(s("g",{class:"bm-wanted",transform:transform(x,y,isPoint(pose)?0:radians(pose.
angle_deg)),"data-pose":k+1},isPoint(pose)?null:s("path",{d:axes(AXIS*small)}),s("circle",{r:4.5*small})));if(data.poses.length<=60&&isNamed(data,k))names.append(
labels.put(x,y,pose.label,13,{}));const row=linkage?.pose_errors[k];if(!row||row.x===null)return;const elsewhere=row.way===this.way?"":" bm-elsewhere";group.append(
s("g",{class:`bm-achieved${elsewhere}`,transform:transform(view.X(row.x),view.Y(row.y),radians(row.angle_deg))},isPoint(pose)?null:s("path",{d:axes(.72*AXIS*small)}),
s("circle",{r:2.2*small})))});group.append(arrows,names);return group}errors(linkage,factor,labels){const{data,view}=this,arrows=s("g",{class:"bm-errors"});if(!linkage||
!factor)return arrows;linkage.pose_errors.forEach((row,k)=>{if(row.x===null)return;const pose=data.poses[k],x=view.X(pose.x),y=view.Y(pose.y);const dx=factor*view.
scale*(row.x-pose.x),dy=-factor*view.scale*(row.y-pose.y);const size2=Math.hypot(dx,dy);if(size2<1.5)return;const head2=Math.min(7,.5*size2),ux=dx/size2,uy=dy/size2;
const tip=`${px(x+dx)} ${px(y+dy)}`;const barb=sign=>`L${px(x+dx-head2*(ux-sign*.5*uy))} ${px(y+dy-head2*(uy+sign*.5*ux))}`;arrows.append(s("path",{d:`M${px(x)}\
 ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}`}));for(let share=0;share<=1;share+=.2)labels.block(x+share*dx,y+share*dy,8,8)});if(arrows.children.length)this.names.
append(scaleOfErrors(view,factor));return arrows}show(place,drive){this.moving?.show(place,drive)}};var scaleOfErrors=({width},factor)=>s("text",{class:"bm-erro\
r-scale",x:width-8,y:16,"text-anchor":"end"},factor===1?"errors to scale":`errors × ${factor.toLocaleString("en").replaceAll(","," ")}`);var hundredths=value=>Math.round(Math.min(Math.max(value,-1e6),1e6)*100)/100;function smoothPath(X,Y,closed2){const last=X.length-1;if(last<1)return"";const ahead=(values,k)=>k<
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
this.playing.here.place,this.playing.here.drive)}shape(){const{playing,answers,scene}=this,{linkage,path:path2}=playing,{view}=scene;const there2=Boolean(linkage)&&
!linkage.gone;for(const part of[this.paths,this.holder,this.labels,this.edges])put(part,"visibility",there2?"visible":"hidden");if(!there2)return;const places=path2?
framesOf(path2):[];this.enlarge();this.curves(linkage,path2,places,view);this.ground(linkage,places,view);this.outside(linkage,view);this.atPoses(linkage,view);
if(!path2){this.mechanism?.group.remove();this.mechanism=null;return}if(!this.mechanism?.fits(linkage)){this.mechanism?.group.remove();this.mechanism=new Mechanism(
linkage);this.holder.append(this.mechanism.group)}this.mechanism.shape(answers.data,linkage,view,places)}curves(linkage,path2,places,view){const set=(element,list2,closed2)=>put(
element,"d",smoothPath(list2.map(([x])=>view.X(x)),list2.map(([,y])=>view.Y(y)),closed2));const others=linkage.ways.filter(way=>way!==path2);put(this.others,"d",
others.map(way=>pathOf2(way,view)).join(""));put(this.beyond,"d",path2?pathOf2(path2,view):"");this.pivotPaths.forEach((element,side)=>{const dyad=linkage.led[side];
if(!path2||!dyad.moving_pivot||dyad.kind==="PR")put(element,"d","");else set(element,places.map(place=>act(place,dyad.moving_pivot)),path2.round)});if(!path2){put(
this.here,"d","");return}const{low,high}=this.playing.player.stretch,{length}=this.answers.data.chart,list=[];const end=u=>(place=>[place.x,place.y])(placeAt(linkage,
path2,u,length));list.push(end(low));for(let k=Math.floor(low)+1;k<high;k+=1)list.push([path2.x[k],path2.y[k]]);list.push(end(high));set(this.here,list,path2.round&&
high-low>path2.x.length-1-1e-6)}ground(linkage,places,view){const{scene}=this;linkage.led.forEach((dyad,side)=>{const[rail,at,name]=[this.rails[side],this.feet[side],
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
x-pose.x),dy=-by*(row.y-pose.y),size2=Math.hypot(dx,dy);if(!(size2>=LEAST_ARROW2))return"";const head2=Math.min(7,.5*size2),ux=dx/size2,uy=dy/size2,tip=`${px(x+
dx)} ${px(y+dy)}`;const barb=sign=>`L${px(x+dx-head2*(ux-sign*.5*uy))} ${px(y+dy-head2*(uy+sign*.5*ux))}`;return`M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(
-1)}`}var FARTHEST=30;var JUMP=2;function centrodesOf(linkage,way,scene,near2){let before=null;const points=framesOf(way).map(place=>{const point2=centrodePoint(linkage.
led,place);const far=!point2||Math.hypot(point2.fixed[0]-near2[0],point2.fixed[1]-near2[1])>FARTHEST*scene;const cut=far||before&&Math.hypot(point2.fixed[0]-before[0],
point2.fixed[1]-before[1])>JUMP*scene;before=far?null:point2.fixed;return{point:far?null:point2,cut}});const pieces2=key=>points.flatMap(({point:point2,cut})=>cut?
[null,point2&&point2[key]]:[point2?.[key]]);return{fixed:pieces2("fixed"),moving:pieces2("moving")}}var path=(points,X,Y)=>{let d="",pen="M";for(const point2 of points){
if(point2)d+=`${pen}${px(X(point2[0]))} ${px(Y(point2[1]))}`;pen=point2?"L":"M"}return d};var Centrodes=class{constructor(answers,playing,scene){this.answers=answers;
this.playing=playing;this.scene=scene;this.fixed=s("path",{class:"bs-centrode bs-fixed-centrode"});this.moving=s("path",{class:"bs-centrode bs-moving-centrode"});
this.mark=s("g",{class:"bs-instant-centre"},s("circle",{r:5}),s("path",{d:"M-9 0H9M0 -9V9"}));this.rays=s("path",{class:"bs-rays"});this.group=s("g",{class:"bs-\
centrodes",visibility:"hidden","aria-hidden":"true"},this.fixed,this.moving,this.rays,this.mark);scene.layer("curves").append(this.group);this.box=h("input",{type:"\
checkbox","data-tool":"centrodes",onchange:()=>this.shape()});this.readout=h("output",{class:"bs-quiet"});this.element=h("div",{class:"bs-tool"},h("label",{},this.
box," Instant centre and centrodes")," ",this.readout);playing.on("shape",()=>this.shape());playing.on("place",({place})=>this.show(place));scene.on("view",()=>this.
shape())}get on(){return this.box.checked&&Boolean(this.playing.path)&&!this.playing.linkage.gone}shape(){put(this.group,"visibility",this.on?"visible":"hidden");
if(!this.on){this.readout.textContent="";return}const{data}=this.answers,{linkage,path:way}=this.playing,{view}=this.scene;const[pose]=data.poses,both=centrodesOf(
linkage,way,data.scene,pose?[pose.x,pose.y]:[0,0]);put(this.fixed,"d",path(both.fixed,view.X,view.Y));put(this.moving,"d",path(both.moving,x=>view.scale*x,y=>-view.
scale*y));if(this.playing.here)this.show(this.playing.here.place)}show(place){if(!this.on)return;const{view}=this.scene,{led}=this.playing.linkage,centre=instantCentre(
led,place);put(this.moving,"transform",transform(view.X(place.x),view.Y(place.y),place.a));const there2=centre&&Math.hypot(centre[0]-place.x,centre[1]-place.y)<
FARTHEST*this.answers.data.scene;put(this.mark,"visibility",there2?"inherit":"hidden");put(this.rays,"visibility",there2?"inherit":"hidden");const digits=decimalsOf(
this.answers.data),unit2=this.answers.data.unit?` ${this.answers.data.unit}`:"";this.readout.textContent=centre?`at (${centre.map(value=>fixed(value,digits)).join(
", ")})${unit2}`:"at infinity: the body only shifts";if(!there2)return;const[x,y]=[view.X(centre[0]),view.Y(centre[1])];put(this.mark,"transform",`translate(${px(
x)} ${px(y)})`);const ends=led.filter(dyad=>dyad.fixed_pivot).map(dyad=>`M${px(view.X(dyad.fixed_pivot[0]))} ${px(view.Y(dyad.fixed_pivot[1]))}L${px(x)} ${px(y)}`);
put(this.rays,"d",ends.join(""))}};var CognatePanel=class{known;constructor(store,answers){this.store=store;this.answers=answers;this.known=null;this.asking=false;this.story=h("p",{class:"bm-stor\
y"});this.cards=h("div",{class:"bs-cognates",role:"group","aria-label":"The linkages of one curve"});this.element=h("div",{class:"bs-cognate-panel"},this.story,
this.cards);this.pace=new Pace(()=>this.renew(),()=>isSeen(this.element));answers.on("answers shown placed",()=>this.pace.ask());store.on("state document",()=>this.
pace.ask());watch(this.element,()=>this.pace.ask())}get of(){const{placed,chosen}=this.store;return this.answers.get(chosen===PLACED?placed?.cognateOf:chosen)??
(chosen===PLACED?void 0:this.answers.shown)}async renew(){const{store,answers}=this,{of}=this;if(!isOfPoints(store.document))return;if(!of||of.gone||answers.isOld)
return this.show(of&&!of.gone?"The cognates are looked for when the answer is there.":"No linkage is there.");const key=store.solved;if(this.known?.key===key&&this.
known.of===of.id)return this.show();if(this.asking||!store.connection?.isOpen)return void 0;this.asking=true;try{const answer=await store.connection.ask({do:"co\
gnates",document:store.document,linkage:of.id});if(answer.kind==="cognates")this.known={key,of:of.id,linkages:answer.linkages.map(linked)}}catch{}this.asking=false;
if(this.known?.key===store.solved&&this.known.of===this.of?.id)return this.show();if(store.solved!==key)this.pace.ask();return void 0}show(instead){const{known,
of}=this,there2=!instead&&known&&of;const none=there2&&!known.linkages.length;say(this.story,instead??(none?`${of.id} has no cognates: a link of theirs would ha\
ve no length.`:"By Roberts' theorem these linkages trace the same curve, with the same error. Choose one by its room, its pivots and its transmission."));this.cards.
replaceChildren(...there2&&!none?[of,...known.linkages].map((each,k)=>this.card(each,k)):[]);give(this.cards,"hidden",!there2||none);put(this.element,"data-of",
there2?of.id:null)}card(linkage,k){const{store,answers:{data}}=this,{of}=this,digits=decimalsOf(data),unit2=data.unit?` ${data.unit}`:"";const point2=at=>`(${at.
map(value=>fixed(value,digits)).join(", ")})`,{links}=linkage.said;const chosen=k?store.chosen===PLACED&&store.placed?.linkage?.id===linkage.id:store.chosen===of.
id;const facts=[["fixed pivots",linkage.led.filter(dyad=>dyad.fixed_pivot).map(dyad=>point2(dyad.fixed_pivot)).join(" and ")],...links?[["links",`${Object.entries(
links).map(([name,value])=>`${name} ${value}`).join(", ")}${unit2}`]]:[],["transmission",leastOf(linkage)==="–"?"–":`${leastOf(linkage)} or more`],["size",linkage.
said.quality.extent??"–"]];return h("article",{class:`bs-card bm-choice ${linkage.usable?"bm-good":"bm-bad"}${chosen?" bs-chosen":""}`,"data-cognate":k},h("bu\
tton",{type:"button",class:"bs-card-main","aria-pressed":String(Boolean(chosen)),onclick:()=>this.choose(k)},h("span",{class:"bm-choice-head"},h("b",{},k?`Cogna\
te ${k}`:of.id)," ",h("span",{class:"bm-type"},linkage.type)),h("span",{class:"bm-verdict"},linkage.usable?"✓ usable":"✕ not usable"),h("dl",{class:"bs-figu\
res"},facts.map(([name,value])=>[h("dt",{},name),h("dd",{},value)])),linkage.usable?null:h("span",{class:"bm-reason"},linkage.said.reasons.join("; "))))}choose(k){
const{store,of,known}=this;if(k)store.takeCognate(known.linkages[k-1],of.id);else if(store.placed?.cognateOf)store.letCognateGo();else store.choose(of.id);this.
show();this.cards.children[k]?.querySelector("button").focus()}};var LEFT2=62;var RIGHT=14;var TOP=22;var BOTTOM=44;var PANEL=84;var ONLY=150;var GAP=28;var MANY_POSES=40;var HEADROOM=1.32;var NO_ERROR=1e-7;var TITLE="Errors \
and transmission angle";var INSET2=8;var LONGEST_NAME5=16;var NAME_WIDTH=11;var Plots=class{top=TOP;count;marks;way;width;X;stretch;across;constructor(data,parent,scrub){
this.data=data;this.parent=parent;this.svg=s("svg",{class:"bm-plots",role:"img","aria-label":TITLE});parent.append(this.svg);const go=event=>{if(!this.way)return;
const box=this.svg.getBoundingClientRect();const at=(event.clientX-box.left-LEFT2-INSET2)/(this.width-LEFT2-RIGHT-2*INSET2);const drive=this.driveAt(this.low+clamp(
at,0,1)*(this.high-this.low));if(drive!==null)scrub(frameAt(this.way.drive,drive))};this.svg.addEventListener("pointerdown",event=>{this.svg.setPointerCapture(event.
pointerId);go(event)});this.svg.addEventListener("pointermove",event=>event.buttons&1&&go(event))}build(linkage,index,stretch){const{data,svg}=this,way=linkage.
ways[index];this.linkage=linkage;this.way=way;svg.replaceChildren();this.cursor=null;if(!way)return;svg.setAttribute("aria-label",`${linkage.id}: ${TITLE.toLowerCase()}\
 along the driver`);const poses=linkage.pose_errors.map((row,k)=>({...row,pose:data.poses[k]})).filter(row=>row.way===index&&row.pose);const upright=poses.some(
({pose})=>pose.label!==pose.name);const longest=Math.max(0,...poses.map(({pose})=>shortened(poseName(pose),LONGEST_NAME5).length));this.top=TOP+(upright?6.2*longest+
6:0);const count=linkage.panels?linkage.panels.length+1:way.loops?1:nounOf(data)==="point"?2:3;const[driver]=linkage.led,slides=driver.kind==="PR";this.stretch=
stretch;const rows=poses.map(row=>({...row,drive:linear(way.drive,row.frame)}));const unit2=data.unit??"unit of the poses";const title=way.told?`${way.told[0].name}\
 (°)`:slides?`place of ${driver.id} on its line (${unit2})`:`driver angle (${driver.id})`;const ends=[stretch.low,stretch.high].map(u=>linear(way.drive,u)),[low,
high]=stretch.sense<0?ends.reverse():ends;this.frame(count,low,high,!slides,title,()=>{this.panels(rows,unit2);if(upright)this.uprightNames(rows)})}frame(count,low,high,turns,title,draw){
const{svg}=this,width=this.width=Math.max(260,this.parent.clientWidth);this.count=count;this.low=low;this.high=high;const base=this.top+(count>1?count*PANEL+(count-
1)*GAP:ONLY),height=base+BOTTOM;svg.setAttribute("viewBox",`0 0 ${width} ${height}`);svg.setAttribute("height",height);this.X=at=>LEFT2+INSET2+(at-low)/(high-low)*
(width-LEFT2-RIGHT-2*INSET2);const ends=[Math.min(low,high),Math.max(low,high)],marks=turns?angleTicks(ends[0],ends[1],Math.max(3,width/70)):ticks(ends[0],ends[1],
width/90);this.across=low>high?marks.reverse():marks;this.marks=[];draw();svg.append(s("text",{class:"bm-title",x:(LEFT2+width-RIGHT)/2,y:height-6,"text-anchor":"\
middle"},title));this.cursor=s("g",{class:"bm-cursor"},s("path",{d:`M0 ${this.top}V${base}`}));this.cursor.append(...this.marks.map(({mark})=>mark));svg.append(
this.cursor)}heights(k){const y0=this.top+k*(PANEL+GAP);return[y0,y0+(this.count>1?PANEL:ONLY)]}placeOf(drive){return drive}driveAt(place){return place}panels(rows,unit2){
this.linkage.panels?.forEach((each,k)=>this.values(k,each));if(this.linkage.panels||this.count===1){this.transmission(this.count-1,rows);return}this.errors(0,`p\
osition error (${unit2})`,rows,row=>row.position,1e-11*this.data.scene);if(nounOf(this.data)==="point"){this.transmission(1,rows);return}this.errors(1,"angle er\
ror (°)",rows.filter(({pose})=>!isPoint(pose)),row=>row.turned_deg,1e-9);this.transmission(2,rows)}errors(k,title,rows,value,rounding){const{svg,X}=this,[y0,base]=this.
heights(k);const greatest=Math.max(1e-300,...rows.map(row=>value(row)??0));const visible=greatest>rounding;const high=visible?HEADROOM*greatest:1;const Y=v=>base-
v/high*PANEL;this.panel(title,y0,base);if(!visible){svg.append(s("text",{class:"bm-note",x:LEFT2+8,y:y0+PANEL/2},rows.length?"exact, up to rounding":`no ${nounOf(
this.data)} is on this assembly`))}else{for(const{at}of ticks(0,high,3).slice(1))this.rule(Y(at),figure(at));svg.append(s("text",{class:"bm-tick",x:LEFT2-6,y:base+
4,"text-anchor":"end"},"0"))}const greatestThree=new Set([...rows].sort((a,b)=>value(b)-value(a)).slice(0,3));let last=-99;for(const row of[...rows].sort((a,b)=>X(
a.drive)-X(b.drive))){const x=px(X(row.drive)),y=px(visible?Y(value(row)):base);svg.append(s("path",{class:"bm-stem",d:`M${x} ${base}V${y}`}),s("circle",{class:"\
bm-dot",cx:x,cy:y,r:3.5},s("title",{},`${calledOf(row.pose)}: ${figure(value(row))}`)));const{label}=row.pose;if(x-last>6+6.5*label.length&&(rows.length<=MANY_POSES||
greatestThree.has(row))){svg.append(s("text",{class:"bm-dot-name",x,y:y-7,"text-anchor":"middle"},label));last=x}}}transmission(k,rows){const{svg,way,width,X}=this,
[y0,base]=this.heights(k);const Y=v=>base-v/90*(base-y0);this.panel("transmission angle (°)",y0,base,true);for(const at of[0,30,60,90])this.rule(Y(at),at);const{
deg:limit,said}=this.data.transmission_limit;svg.append(s("path",{class:"bm-usual",d:`M${LEFT2} ${px(Y(limit))}H${width-RIGHT}`}));const below=limit>15&&(linear(
way.transmission,this.stretch.sense<0?this.stretch.low:this.stretch.high)??90)>limit;const limitName2=s("text",{class:"bm-tick bm-halo",x:width-RIGHT-4,y:px(Y(limit))+
(below?12:-4),"text-anchor":"end"},said);(way.loops??[way.transmission]).forEach((values,loop)=>{this.mark(drive=>linear(values,frameAt(way.drive,drive)),Y);const kind=way.
loops?` bm-loop${loop}`:"";this.curve(values,Y,`bm-line${kind}`);for(const row of rows){const value=way.loops?row.loops[loop]:row.transmission_deg;if(value!==null)
svg.append(s("circle",{class:`bm-dot${kind}`,cx:px(X(row.drive)),cy:px(Y(value)),r:3}))}});svg.append(limitName2)}mark(value,Y){this.marks.push({mark:s("circle",
{r:4.5}),value,Y})}values(k,curve){const{title,x,y,dots,stems}=curve,{svg}=this,[low,high]=[Math.min(this.low,this.high),Math.max(this.low,this.high)],[y0,base]=this.
heights(k);const shown2=[...x.keys()].filter(i=>y[i]!==null&&x[i]>=low&&x[i]<=high).map(i=>[x[i],y[i]]);const all=[...shown2,...dots].map(([,value])=>value),least2=Math.
min(...all),most=Math.max(...all),room=.08*(most-least2);this.panel(title,y0,base);if(!(Math.max(Math.abs(least2),Math.abs(most))>NO_ERROR)){svg.append(s("text",
{class:"bm-note",x:LEFT2+8,y:y0+PANEL/2},shown2.length?"exact, up to rounding":"it cannot be assembled"));return}const Y=v=>base-(v-least2+room)/(most-least2+2*
room)*PANEL;const at=point2=>`${px(this.X(point2[0]))} ${px(Y(point2[1]))}`;for(const{at:value,text}of ticks(least2,most,4))this.rule(Y(value),text);if(least2<0&&
most>0)svg.append(s("path",{class:"bm-usual",d:`M${LEFT2} ${px(Y(0))}H${this.width-RIGHT}`}));if(stems)for(const[a,b]of shown2)svg.append(s("path",{class:"bm-st\
em",d:`M${at([a,0])}L${at([a,b])}`}));else svg.append(s("path",{class:"bm-line",d:`M${shown2.map(at).join("L")}`}));for(const[a,b]of dots)svg.append(s("circle",
{class:"bm-dot",cx:px(this.X(a)),cy:px(Y(b)),r:3.5},s("title",{},`${figure(b)}°`)));this.mark(drive=>valueAt(curve,drive),Y)}curve(values,Y,name){const{low,high}=this.
stretch,frames=[low];for(let i=Math.floor(low)+1;i<high;i+=1)frames.push(i);frames.push(high);let line2="",pen="M";for(const u of frames){const value=linear(values,
u);if(value===null)continue;line2+=`${pen}${px(this.X(linear(this.way.drive,u)))} ${px(Y(value))}`;pen="L"}this.svg.append(s("path",{class:name,d:line2}))}uprightNames(rows){
let last=-99;for(const row of[...rows].sort((a,b)=>this.X(a.drive)-this.X(b.drive))){const x=this.X(row.drive),y=this.top-20;if(x-last<NAME_WIDTH)continue;last=
x;const text=s("text",{class:"bm-dot-name bm-upright",transform:`translate(${px(x+4)} ${px(y)}) rotate(-90)`});text.append(shortened(poseName(row.pose),LONGEST_NAME5));
this.svg.append(s("g",{},s("title",{},poseName(row.pose)),text))}}panel(title,y0,base,labelled3=false){const{svg,width}=this;svg.append(s("rect",{class:"bm-pane\
l",x:LEFT2,y:y0,width:width-LEFT2-RIGHT,height:base-y0}),s("text",{class:"bm-title",x:LEFT2,y:y0-7},title));let last=-99;for(const{at,text}of this.across){const x=px(
this.X(at));svg.append(s("path",{class:"bm-rule",d:`M${x} ${y0}V${base}`}));if(labelled3&&x-last>34){svg.append(s("text",{class:"bm-tick",x,y:base+15,"text-anch\
or":"middle"},text));last=x}}}rule(y,text){this.svg.append(s("path",{class:"bm-rule",d:`M${LEFT2} ${px(y)}H${this.width-RIGHT}`}),s("text",{class:"bm-tick",x:LEFT2-
6,y:px(y)+4,"text-anchor":"end"},text))}show(drive){if(!this.cursor)return;const at=this.placeOf(drive);put(this.cursor,"visibility",at===null?"hidden":"visible");
if(at===null)return;this.cursor.setAttribute("transform",`translate(${px(this.X(at))} 0)`);for(const{mark,value,Y}of this.marks){const known=value(at);put(mark,
"visibility",known===null?"hidden":"inherit");if(known!==null)put(mark,"cy",px(Y(known)))}}};var TITLE2="Loads";var fieldsets=0;var LoadPlots=class extends Plots{own=null;timed=null;drive;overTime=false;constructor(data,parent,scrub){super(data,parent,scrub);
const name=`bm-over-${fieldsets+=1}`;const one=(text,overTime)=>h("label",{},h("input",{type:"radio",name,checked:!overTime,onchange:()=>this.take(overTime)}),h(
"span",{},text));this.choice=h("fieldset",{class:"bm-ways bm-over",hidden:true},one("Over the driver",false),one("Over time",true));this.nothing=h("p",{class:"b\
m-note-text",hidden:true},"Loads are known from the first pose to the last, of a linkage that leads through all of them with its own driver.");this.forces=h("la\
bel",{class:"bm-forces",hidden:true},h("input",{type:"checkbox",class:"bm-show-forces"}),h("span",{},"Draw the forces of pins: of the link or the ground that ho\
lds a pin, on the other link; all to one scale"));parent.prepend(this.choice,this.forces,this.nothing)}take(overTime){this.overTime=overTime;this.draw();if(this.
drive!==void 0)this.show(this.drive)}build(linkage,index){this.svg.classList.toggle("bm-stale",Boolean(linkage?.followed));this.linkage=linkage;const loads=linkage?.
loads,here=Boolean(loads)&&loads.way===index&&Boolean(linkage.ways[index]);this.own=here?loads:null;this.way=here?linkage.ways[index]:null;this.choice.hidden=!this.
own?.timed;this.nothing.hidden=here;this.forces.hidden=!here;this.draw()}draw(){const{svg,own,data}=this;svg.replaceChildren();svg.removeAttribute("height");this.
cursor=null;if(!own)return;const timed=this.overTime&&own.timed?own.timed:null,panels=(timed??own).panels,{x}=panels[0];this.timed=timed;const[driver]=this.linkage.
led,slides=driver.kind==="PR";const title=timed?"time (s)":slides?`place of ${driver.id} on its line (${data.unit})`:`driver angle (${driver.id})`;svg.setAttribute(
"aria-label",`${this.linkage.id}: ${TITLE2.toLowerCase()} over ${timed?"time":"the driver"}`);const ends=[x[0],x[x.length-1]],[low,high]=!timed&&stretchOf(this.
linkage,own.way).sense<0?ends.reverse():ends;this.frame(panels.length,low,high,!slides&&!timed,title,()=>{panels.forEach((each,k)=>this.lines(k,each,k+1===panels.
length))})}lines(k,{title,x,lines},last){const all=lines.flatMap(({y})=>y.filter(each=>each!==null)),[y0,base]=this.heights(k);const least2=Math.min(0,...all),most=Math.
max(0,...all),room=.08*(most-least2||1);this.panel(title,y0,base,last);const Y=v=>base-(v-least2+room)/(most-least2+2*room)*(base-y0);for(const{at,text}of ticks(
least2,most,4))this.rule(Y(at),text);if(least2<0&&most>0)this.svg.append(s("path",{class:"bm-usual",d:`M${LEFT2} ${px(Y(0))}H${this.width-RIGHT}`}));lines.forEach(
({y},line2)=>{let d="",pen="M";x.forEach((at,i)=>{if(y[i]===null)pen="M";else{d+=`${pen}${px(this.X(at))} ${px(Y(y[i]))}`;pen="L"}});this.svg.append(s("path",{class:`\
bm-line bm-curve${line2}`,d}));this.mark(at=>valueAt({x,y},at),Y)});if(lines.length>1){const names=s("text",{class:"bm-title",x:this.width-RIGHT,y:y0-7,"text-an\
chor":"end"});lines.forEach(({name},line2)=>names.append(s("tspan",{class:`bm-curve${line2}`,dx:line2?7:0},name)));this.svg.append(names)}}placeOf(drive){const{
own,timed}=this;if(this.linkage.followed)return null;if(timed)return valueAt(timed.time,drive);const{x}=own.panels[0];return drive<x[0]-1e-6||drive>x[x.length-1]+
1e-6?null:drive}driveAt(at){return this.timed?driveAtTime(this.timed,at):at}show(drive){this.drive=drive;super.show(drive)}};var NO_MOTION="No linkage is there whose motion could be shown.";var Curves=class{constructor(answers,playing,Kind){this.playing=playing;const fill=h("div",{class:"\
bm-fill"});this.plots=new Kind(answers.data,fill,u=>playing.player.go(u));this.nothing=h("p",{class:"bs-quiet",hidden:true},NO_MOTION);this.element=h("div",{},this.
nothing,fill);this.pace=new Pace(()=>this.build(),()=>isSeen(fill));playing.on("shape",()=>this.pace.ask());playing.on("place",({drive})=>{if(this.isFresh&&isSeen(
fill))this.plots.show(drive)});answers.on("poses",()=>this.isFresh=false);new ResizeObserver(()=>this.pace.ask()).observe(fill);watch(fill,()=>this.pace.ask())}build(){
const{playing,plots}=this,{linkage,path:path2,player}=playing;give(this.nothing,"hidden",Boolean(linkage&&path2&&!linkage.gone));if(!linkage||!path2||linkage.gone||
linkage.pose_errors.length!==plots.data.poses.length){plots.svg.replaceChildren();plots.way=plots.cursor=null;return}plots.build(linkage,player.way,player.stretch);
this.isFresh=true;if(playing.here)plots.show(playing.here.drive)}};var Charts=class extends Curves{constructor(answers,playing){super(answers,playing,Plots)}};var LoadCharts=class extends Curves{constructor(answers,playing){
super(answers,playing,LoadPlots)}};var stopsOf=(linkage,index)=>linkage.pose_errors.map((row,k)=>({k,way:row.way,frame:row.frame})).filter(stop=>stop.way===index).sort((a,b)=>a.frame-b.frame);function stageOf(linkage,index,u){
const stops=stopsOf(linkage,index);if(!stops.length)return null;if(stops.length===1)return{from:stops[0].k,to:stops[0].k,share:0};let at=0;while(at+2<stops.length&&
stops[at+1].frame<=u)at+=1;const[a,b]=[stops[at],stops[at+1]],step=b.frame-a.frame;const share=step>0?(u-a.frame)/step:0;return{from:a.k,to:b.k,share:Math.min(Math.
max(share,-1),2)}}var there=row=>Boolean(row)&&row.way!==null;function frameAtStage(linkage,stage){if(!stage)return null;const[a,b]=[stage.from,stage.to].map(k=>linkage.
pose_errors[k]);if(!there(a)||!there(b)||a.way!==b.way){const[near2,other]=stage.share<.5?[a,b]:[b,a];const row=there(near2)?near2:there(other)?other:null;return row&&
{way:row.way,u:row.frame}}const way=linkage.ways[a.way],last=way.x.length-1;let step=b.frame-a.frame;if(way.round&&Math.abs(step)>last/2)step-=Math.sign(step)*last;
const u=a.frame+stage.share*step;return{way:a.way,u:way.round?(u%last+last)%last:Math.min(Math.max(u,0),last)}}function comparison(one,other,data){const unit2=data.unit?` ${data.unit}`:"",both=[one,other];const least2=values=>values.every(Number.isFinite)&&values[0]!==values[1]?
values[0]<values[1]?0:1:null;const row=(name,text,value,sign=1)=>({name,texts:both.map(text),better:value?least2(both.map(each=>sign*(value(each)??NaN))):null});
const links=["ground","driver","coupler","follower"];return[row("verdict",each=>each.gone?"gone":each.usable?"usable":"not usable",each=>each.usable?0:1),row("t\
ype",each=>each.type),row("worst miss",each=>worstOf(each,data),each=>each.worst),row("least transmission angle",each=>leastOf(each),each=>each.least,-1),row("s\
ize",each=>each.quality?spans(each.quality.extent):"–",each=>each.quality?.extent),row("sensitivity",each=>each.quality?figure(each.quality.sensitivity):"–",
each=>each.quality?.sensitivity),row("driver",each=>each.led[0].id),...links.map(name=>row(`${name} link`,each=>each.said.links?.[name]?`${each.said.links[name]}${unit2}`:
"–")),row("reason",each=>each.usable?"–":(each.followed?each.reason:each.said.reasons.join("; "))||"–")]}var Compare=class{constructor(store,answers,playing,onstart){
this.store=store;this.onstart=onstart;this.answers=answers;this.playing=playing;this.pictures=[0,1].map(()=>h("div",{class:"bm-drawing"}));this.planes=this.pictures.
map(parent=>new Plane(answers.data,parent));this.names=[0,1].map(()=>h("h3",{}));this.places=[0,1].map(()=>h("p",{class:"bs-quiet"}));this.table=h("div",{class:"\
bm-scroll",tabindex:0,role:"region","aria-label":"Both linkages in numbers"});this.button=h("button",{type:"button",class:"bm-button",onclick:()=>playing.player.
play(!playing.player.playing)},"Play both");this.close=h("button",{type:"button",class:"bs-small",onclick:()=>store.compared&&store.compare(store.compared)},"En\
d the comparison");this.pairs=h("div",{class:"bs-beside"},[0,1].map(k=>h("div",{},this.names[k],this.pictures[k],this.places[k])));this.empty=h("p",{class:"bm-s\
tory"},"Press “Compare” on a card: that linkage moves beside the chosen one.");this.full=h("div",{hidden:true},this.pairs,h("div",{class:"bs-tool"},this.button,
" ",this.close),this.table);this.element=h("div",{class:"bs-compare"},this.empty,this.full);this.pace=new Pace(()=>this.build(),()=>this.on&&isSeen(this.element));
answers.on("answers shown",()=>this.start());playing.on("shape",()=>this.pace.ask());playing.on("place",here=>this.show(here));new ResizeObserver(()=>this.pace.
ask()).observe(this.element);watch(this.element,()=>this.pace.ask())}get other(){return this.answers.get(this.store.compared)}get on(){return Boolean(this.other&&
this.playing.linkage&&this.other!==this.answers.shown)}start(){give(this.full,"hidden",!this.on);give(this.empty,"hidden",this.on);if(!this.on)return void(this.
began=null);if(this.began!==this.other)this.onstart();this.began=this.other;this.build()}build(){if(!this.on)return;const{answers,playing,other}=this,mine=playing.
linkage;const options={factor:0,fill:0,far:false};this.names.forEach((name,k)=>name.textContent=[mine,other][k].id==="placed"?"By hand":`${[mine,other][k].id}: ${[
mine,other][k].type}`);this.planes[0].build(mine,playing.player.way,playing.player.stretch,options);this.way=null;this.buildTable(comparison(mine,other,answers.
data));if(playing.here)this.show(playing.here)}buildTable(rows){const old=this.answers.isOld?"bs-old":null;this.table.replaceChildren(h("table",{class:"bs-compa\
red"},h("caption",{},"Both linkages in numbers; the better one of each row is bold"),h("thead",{},h("tr",{},h("th",{scope:"col"},""),this.names.map(name=>h("th",
{scope:"col"},name.textContent)))),h("tbody",{},rows.map(({name,texts,better})=>h("tr",{class:/size|sensitivity|link/.test(name)?old:null},h("th",{scope:"row"},
name),texts.map((text,k)=>h("td",{class:"bm-words"},better===k?h("b",{},text):text)))))))}show({place,transmission}){if(!this.on||!isSeen(this.element))return;const{
playing,other,answers:{data}}=this,{player}=playing;this.planes[0].show(place);this.tell(0,transmission);const at=frameAtStage(other,stageOf(playing.linkage,player.
way,player.u));this.pictures[1].classList.toggle("bs-old",!at);if(!at){this.planes[1].build(other,0,{low:0,high:(other.ways[0]?.x.length??2)-1},{factor:0,fill:0,
far:false});this.places[1].textContent="It does not reach this pose.";return}if(this.way!==at.way){this.way=at.way;const stops=other.pose_errors.filter(row=>row.
way===at.way).map(row=>row.frame);const[low,high]=[Math.min(...stops),Math.max(...stops)];this.planes[1].build(other,at.way,high>low?{low,high}:{low:0,high:other.
ways[at.way].x.length-1},{factor:0,fill:0,far:false})}const way=other.ways[at.way];this.planes[1].show(placeAt(other,way,at.u,data.chart.length));this.tell(1,way.
transmission[Math.round(at.u)])}tell(k,transmission){const text=`transmission angle ${transmission===null||!Number.isFinite(transmission)?"–":`${fixed(transmission,
1)}°`}`;say(this.places[k],text)}};var MOST2=8;var ARROWS3={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]};var curveOf=(way,point2)=>framesOf(way).map(place=>act(place,point2));
var CouplerCurves=class{constructor(answers,playing,scene){this.answers=answers;this.playing=playing;this.scene=scene;this.points=[];this.group=s("g",{class:"bs\
-coupler-curves"});this.handles=s("g",{class:"bs-coupler-points"});scene.layer("paths").append(this.group);scene.layer("pivots").append(this.handles);this.button=
h("button",{type:"button",class:"bs-small","aria-pressed":"false","data-tool":"coupler-point",onclick:()=>this.pick()},"Pick a point on the body");this.list=h("\
ul",{class:"bs-points"});this.readout=h("output",{class:"bs-quiet"});this.element=h("div",{class:"bs-tool"},this.button," ",this.readout,this.list);this.tool={name:"\
coupler-point",hint:"Click on the body: the curve of that point is drawn. Escape ends.",click:({x,y})=>this.add([x,y]),key:event=>{if(event.key!=="Escape")return false;
scene.use?.(null);return true},end:()=>put(this.button,"aria-pressed","false")};playing.on("shape",()=>this.shape());playing.on("place",({place})=>this.show(place));
scene.on("view",()=>this.shape());this.tell()}pick(){const on=this.scene.tool!==this.tool;this.scene.use?.(on?this.tool:null);put(this.button,"aria-pressed",String(
on))}add(at,inBody2=false){const place=this.playing.here?.place;if(!place&&!inBody2||this.points.length>=MOST2)return;const point2={at:inBody2?at:this.rounded(back(
place,at)),path:s("path",{class:"bm-curve bs-coupler-curve"})};point2.handle=s("g",{class:"bs-coupler-point",tabindex:0,role:"button","data-point":this.points.length+
1},s("circle",{class:"bs-hold",r:13}),s("circle",{class:"bs-coupler-dot",r:4.5}));this.drag(point2);this.points.push(point2);this.group.append(point2.path);this.
handles.append(point2.handle);this.number();this.shape()}remove(point2){this.points=this.points.filter(each=>each!==point2);point2.path.remove();point2.handle.remove();
this.number();this.shape()}number(){this.points.forEach((point2,k)=>point2.handle.dataset.point=k+1)}rounded(point2){return point2.map(value=>Number(value.toFixed(
clamp(decimalsOf(this.answers.data),0,12))))}drag(point2){let before;this.scene.drag?.(point2.handle,{start:()=>{before=point2.at;this.playing.player.play(false)},
move:({x,y})=>this.put(point2,back(this.playing.here.place,[x,y])),cancel:()=>this.put(point2,before)});point2.handle.addEventListener("keydown",event=>{const arrow2=ARROWS3[event.
key];if(event.ctrlKey||event.metaKey)return;if(arrow2){const step=(this.scene.step??this.answers.data.scene/100)*(event.shiftKey?10:event.altKey?.1:1);this.put(
point2,point2.at.map((value,k)=>value+step*arrow2[k]))}else if(event.key==="Delete"||event.key==="Backspace"){this.remove(point2)}else{return}event.preventDefault()})}put(point2,at){
point2.at=this.rounded(at);this.shape()}shape(){const{path:path2,linkage}=this.playing,{view}=this.scene,there2=path2&&!linkage.gone;for(const point2 of this.points){
const list=there2?curveOf(path2,point2.at):[];put(point2.path,"d",smoothPath(list.map(([x])=>view.X(x)),list.map(([,y])=>view.Y(y)),path2?.round));put(point2.handle,
"visibility",there2?"visible":"hidden")}if(there2&&this.playing.here)this.show(this.playing.here.place);this.tell()}show(place){const{view}=this.scene;for(const point2 of this.
points){const[x,y]=act(place,point2.at);put(point2.handle,"transform",transform(view.X(x),view.Y(y),0))}}tell(){const digits=decimalsOf(this.answers.data),key=`${this.
points.map(({at})=>at.join()).join(" ")} ${digits}`;if(key===this.told)return;this.told=key;this.readout.textContent=this.points.length?"":"Its curve is drawn, \
and goes along with every change.";this.list.replaceChildren(...this.points.map((point2,k)=>{const name=`Point ${k+1} at (${point2.at.map(value=>fixed(value,digits)).
join(", ")}) of the body`;put(point2.handle,"aria-label",`${name}. Drag it, or use the arrow keys; Delete removes it.`);return h("li",{},name," ",h("button",{type:"\
button",class:"bs-small","aria-label":`Remove point ${k+1}`,onclick:()=>this.remove(point2)},"Remove"))}))}};function wayStory(way,poses){const noun=nounOf({poses}),names=poses.map(pose=>pose.label);const all=way.poses.length===names.length;const here=all?`all ${noun}s`:
way.poses.length?`${noun}${way.poses.length>1?"s":""} ${runs(way.poses,names)}`:`no ${noun}`;const dead=way.dead.filter(Boolean).length;const ends=way.round?"tu\
rns round":dead===2?"between two dead points":dead?"up to a dead point":"open";return`${here}; ${ends}`}var factsOf=({said})=>h("dl",{class:"bm-facts"},said.facts.
map(([name,value])=>h("div",{},h("dt",{},name),h("dd",{},value))));function spaceStory(data,linkage){const some2=data.poses.some(isPoint),every=nounOf(data)==="\
point";const taken=some2&&linkage?`the places that ${linkage.id} takes at ${every?"the":"its"} points`:"";const marked=[every?"":"the poses",taken].filter(Boolean).
join(" and ");const plain=`Every place of the body is one point of this space${marked?`; numbered points are ${marked}`:""}.`;if(!linkage)return[plain];const surface=side=>h(
"b",{class:`bm-side${side}`},linkage.led[side].id);return[plain," The surfaces are all places that dyad ",surface(0)," (driver) and dyad ",surface(1)," (followe\
r) allow; where they meet, the line, the coupler moves."]}function table2(caption,heads,rows){return h("div",{class:"bm-scroll",tabindex:0,role:"region","aria-label":caption},h("table",{},h("caption",{},caption),h("the\
ad",{},h("tr",{},heads.map(head2=>h("th",{scope:"col"},head2)))),h("tbody",{},rows.map(row=>h("tr",{},row.map((text,k)=>k?h("td",{},text):h("th",{scope:"row"},text)))))))}
var point=(at,digits)=>`(${at.map(value=>fixed(value,digits)).join(", ")})`;function poseFacts(linkage,data,points){const digits=decimalsOf(data);return linkage.
pose_errors.map((row,k)=>{const name=data.poses[k]?poseName(data.poses[k]):String(k+1);if(row.x===null)return[name,"–",...points.map(()=>"–")];const place=placeOf(
row),centre=instantCentre(linkage.led,place);return[name,centre?point(centre,digits):"at infinity",...points.map(each=>point(act(place,each.at),digits))]})}var FactsTable=class{constructor(store,answers,playing,curves){
this.store=store;this.answers=answers;this.playing=playing;this.curves=curves;this.element=h("div",{class:"bs-facts"});this.pace=new Pace(()=>this.build(),()=>isSeen(
this.element));playing.on("shape",()=>this.pace.ask());answers.on("answers poses placed",()=>this.pace.ask());watch(this.element,()=>this.pace.ask());this.element.
append(h("p",{class:"bm-story"},"Nothing is known yet."))}build(){const{answers,playing}=this,{data,isOld}=answers,{linkage}=playing;const parts=[];const part=(title,old,...content)=>parts.
push(h("section",{class:old?"bs-old":null,"aria-label":title},h("h3",{},title),old?h("p",{class:"bs-quiet"},"As of the last whole answer."):null,content));const fits=linkage&&
linkage.pose_errors.length===data.poses.length;if(linkage){const name=linkage.id===PLACED?"Pivots put down by hand":`${linkage.id}: ${linkage.type}`;const live=linkage.
followed||playing.isOther;part(name,false,live?this.followedFacts(linkage):[h("p",{class:"bm-story"},linkage.said.story),dimensionTable(data,{...linkage,id:linkage.
id===PLACED?"the linkage by hand":linkage.id}),factsOf(linkage)])}part("Pose by pose",false,poseTable(data,fits?linkage:void 0));if(fits){const points=this.curves?.
points??[];part("Instant centre and picked points",false,table2("At each pose, in F",["pose","instant centre",...points.map((each,k)=>`point ${k+1}`)],poseFacts(
linkage,data,points)))}if(this.store.placed)part("Pivots put down by hand",false,this.placedTable());if(data.linkages.length)part("All linkages",isOld,this.linkages());
if(data.dyads.length)part("Dyads",isOld,dyadTable(data));if(linkage&&!linkage.followed&&linkage.said.manifolds?.[0].length&&!playing.isOther)part("Image space",
isOld,imageTables(data,linkage));this.element.replaceChildren(...parts)}followedFacts(linkage){const{data}=this.answers;return[table2(`Dimensions of ${linkage.id}${inUnit(
data)}`,["","","value"],dimensionsOf(linkage,data).map(({dyad,what,value})=>[dyad,what,value])),table2("Verdict",["","value"],[["verdict",linkage.gone??(linkage.
usable?"usable":`not usable: ${linkage.reason??linkage.said.reasons.join("; ")}`)],["worst miss",worstOf(linkage,data)],["least transmission angle",leastOf(linkage)],
["driver",linkage.led[0].id]])]}linkages(){const{answers}=this,{data}=answers;if(!answers.linkages.some(each=>each.followed))return worded(data,{...data.table,class:"\
bm-linkages bm-stacks"});return table2("All linkages, followed",["","verdict","type","worst miss","least transmission"],answers.linkages.map(each=>[each.id,each.
gone?"gone":each.usable?"usable":"not usable",each.type,worstOf(each,data),leastOf(each)]))}placedTable(){const{placed}=this.store,unit2=inUnit(this.answers.data);
return table2(`Their dyads${unit2}`,["","on the ground (F)","on the body (M)","length","rms miss","worst miss"],placed.dyads.map(dyad=>[dyad.id,dyad.said.ground,
dyad.said.body,dyad.said.length,dyad.said.rms,dyad.said.worst]))}};var CLASSES=7;var OUTSIDE2=2;var FamilyPairs=class{constructor(data){this.data=data;this.map=data.family_map;this.isCurve=this.map.kind==="curve";this.columns=this.isCurve?this.map.fixed.length:
this.map.columns;this.rows=this.isCurve?this.columns:this.map.rows;this.starts=[];(this.map.loops??[]).reduce((start,size2)=>(this.starts.push(start),start+size2),
0)}letter(loop){return this.starts.length>1?`${"ABCDEFGH"[loop]} `:""}pair([i,j]){const{cells:cells2}=this.map;if(!this.isCurve)return this.decoded(cells2[j*this.
columns+i]);if(i===j)return{kind:CLASSES-1,driver:0,degrees:0};const[a,b]=[Math.min(i,j),Math.max(i,j)],n=this.columns;const pair=this.decoded(cells2[a*n-a*(a+1)/
2+b-a-1]);return i<j?pair:{...pair,driver:1-pair.driver}}decoded(code){const rest=Math.floor(code/CLASSES);return{kind:code%CLASSES,driver:rest%2,degrees:Math.floor(
rest/2)}}bestPartner(i){let best={kind:CLASSES-1,degrees:0};for(let j=0;j<this.columns;j+=1){const pair=this.pair([i,j]);if(pair.kind<best.kind||pair.kind===best.
kind&&pair.degrees>best.degrees)best=pair}return best}placeName(k){const loop=this.starts.findLastIndex(start=>start<=k),size2=this.map.loops[loop];return`${this.
letter(loop)}${((k-this.starts[loop]+.5)/size2).toFixed(2)}`}cellOf(pivot){if(!pivot)return null;const{low,high}=this.map,many=[this.columns,this.rows];const at=pivot.
map((v,k)=>Math.round((v-low[k])/(high[k]-low[k])*(many[k]-1)));return at.every((v,k)=>v>=0&&v<many[k])?at:null}pivotOf(cell){const{low,high}=this.map,many=[this.
columns,this.rows];return cell.map((v,k)=>low[k]+v/(many[k]-1)*(high[k]-low[k]))}dyadsOf(cell){const{map}=this;if(this.isCurve)return cell.map(k=>({fixed:map.fixed[k],
moving:map.moving[k],length:map.length[k]}));return[map.chosen,dyadOfThree(this.data.poses,this.pivotOf(cell))]}pinsOf(cell){if(!cell)return[];return this.dyadsOf(
cell).flatMap(each=>[...each.fixed?[each.fixed]:[],...each.moving?[this.seen(each.moving)]:[]])}seen([x,y]){const[pose]=this.data.poses,turn=pose.angle_deg*Math.
PI/180,[cos,sin]=[Math.cos(turn),Math.sin(turn)];return[pose.x+cos*x-sin*y,pose.y+sin*x+cos*y]}};function dyadOfThree(poses,pivot){const[a,b,c]=poses.map(pose=>{
const turn=-pose.angle_deg*Math.PI/180,[x,y]=[pivot[0]-pose.x,pivot[1]-pose.y];return[Math.cos(turn)*x-Math.sin(turn)*y,Math.sin(turn)*x+Math.cos(turn)*y]});const u=[
b[0]-a[0],b[1]-a[1]],v=[c[0]-a[0],c[1]-a[1]];const cross3=2*(u[0]*v[1]-u[1]*v[0]),uu=u[0]**2+u[1]**2,vv=v[0]**2+v[1]**2;const arm=[(uu*v[1]-vv*u[1])/cross3,(vv*
u[0]-uu*v[0])/cross3];return{fixed:pivot,moving:[a[0]+arm[0],a[1]+arm[1]],length:Math.hypot(...arm)}}var NEWTON_STEPS=6;var FARTHEST_STEP=.1;function nearestOnCurve(points,loops,wanted,widest){let best=null,start=0;for(const size2 of loops){for(let i=0;i<size2;i+=
1){const j=(i+1)%size2,a=points[start+i],b=points[start+j];const d=[b[0]-a[0],b[1]-a[1]],squared=d[0]*d[0]+d[1]*d[1];if(squared>widest*widest)continue;const t=squared>
0?Math.min(1,Math.max(0,((wanted[0]-a[0])*d[0]+(wanted[1]-a[1])*d[1])/squared)):0;const at=[a[0]+t*d[0],a[1]+t*d[1]],away=Math.hypot(at[0]-wanted[0],at[1]-wanted[1]);
if(!best||away<best.away)best={k:start+i,next:start+j,share:t,at,away}}start+=size2}return best}function circleDeterminant([o,...others]){const[a,b,c]=others.map(
([x,y])=>[x-o[0],y-o[1]]).map(([x,y])=>[x,y,x*x+y*y]);return a[2]*(b[0]*c[1]-b[1]*c[0])-b[2]*(a[0]*c[1]-a[1]*c[0])+c[2]*(a[0]*b[1]-a[1]*b[0])}function ontoCurve(poses,plane,point2,scene){
const places=poses.map(pose=>({x:pose.x,y:pose.y,a:radians(pose.angle_deg)}));const value=at2=>circleDeterminant(places.map(place=>plane==="F"?back(place,at2):act(
place,at2)));const step=1e-6*scene;let at=point2;for(let k=0;k<NEWTON_STEPS;k+=1){const slope=[0,1].map(axis=>{const[up,down]=[1,-1].map(sense=>value(at.map((each,n)=>each+
(n===axis?sense*step:0))));return(up-down)/(2*step)});const squared=slope[0]**2+slope[1]**2,here=value(at);if(!(squared>0))return at;at=at.map((each,n)=>each-here*
slope[n]/squared)}return Math.hypot(at[0]-point2[0],at[1]-point2[1])<FARTHEST_STEP*scene?at:point2}var worthOf=pairs=>Array.from({length:pairs.columns},(_,k)=>worth(
pairs.bestPartner(k).kind));var worth=kind=>kind<OUTSIDE2?"works":kind===OUTSIDE2?"outside":"fails";function curvesOf({loops}){const curves={fixed:[],moving:[],
loops:[],worth:[]};for(const loop of loops){const kept2=loop.fixed.map((_,k)=>k).filter(k=>[...loop.fixed[k],...loop.moving[k]].every(Number.isFinite));curves.loops.
push(kept2.length);for(const k of kept2){curves.fixed.push(loop.fixed[k]);curves.moving.push(loop.moving[k]);curves.worth.push(loop.class?worth(loop.class[k]):"\
plain")}}return curves}function curvePaths(points,loops,worth2,X,Y,widest){const paths={works:"",outside:"",fails:"",plain:""};const near2=(p,q)=>Math.hypot(p[0]-
q[0],p[1]-q[1])<=widest;const text=([x,y])=>`${Math.round(X(x)*100)/100} ${Math.round(Y(y)*100)/100}`;const between2=(p,q)=>[(p[0]+q[0])/2,(p[1]+q[1])/2];let start=0;
for(const size2 of loops){for(let i=0;i<size2;i+=1){const[a,b,c]=[-1,0,1].map(step=>points[start+(i+step+size2)%size2]);const list=[...near2(a,b)?[between2(a,b)]:
[],b,...near2(b,c)?[between2(b,c)]:[]];if(list.length>1)paths[worth2[start+i]]+=`M${list.map(text).join("L")}`}start+=size2}return paths}var LONGEST_STEP2=.5;var STROKES=["plain","fails","outside","works"];var FamilyCurves=class{constructor(store,answers,playing,scene){this.store=store;this.answers=
answers;this.playing=playing;this.scene=scene;this.known=null;this.live=null;this.asking=false;this.curves=["F","M"].map(plane=>s("g",{class:`bs-curve bs-curve-${plane}`},
STROKES.map(name=>s("path",{class:`bs-curve-${name}`}))));this.group=s("g",{class:"bs-burmester",visibility:"hidden","aria-hidden":"true"},this.curves);scene.layer(
"curves").append(this.group);this.box=h("input",{type:"checkbox",checked:true,"data-tool":"burmester-curves",onchange:()=>this.draw()});this.label=h("label",{hidden:true},
this.box," Burmester curves of the four poses, in the drawing");this.legend=h("p",{class:"bm-legend",hidden:true},h("span",{class:"bs-key-works"})," works with \
a partner; ",h("span",{class:"bs-key-outside"})," works outside limits or standard; ",h("span",{class:"bs-key-fails"})," no partner works. Solid: centre points \
in F; dashed: circle points in M, where the body is now.");answers.on("poses",()=>answers.data.poses.length===4?this.ask():this.draw());playing.on("place",()=>this.
move());scene.on("view",()=>this.draw())}get family(){const{data,isOld}=this.answers;if(data.poses.length!==4)return null;if(this.live&&(isOld||!this.known))return this.
live;return this.known}renew(){const{data}=this.answers,map=data.family_map;this.known=map?.kind==="curve"?{...map,worth:worthOf(new FamilyPairs(data))}:null;this.
live=null;if(!this.known)this.ask();give(this.label,"hidden",data.poses.length!==4);this.draw()}async ask(){const{store,answers}=this,{document:document2,options}=store;
if(document2.poses.length!==4||!this.box.checked||this.asking||!store.connection?.isOpen)return;this.asking=true;try{const answer=await store.connection.ask({do:"\
curve",document:document2,options,judged:store.state!=="dragging"});if(answer.kind==="curve"&&store.document.poses.length===4){this.live=curvesOf(answer);this.draw()}}catch{}
this.asking=false;if(store.document!==document2&&answers.isOld)this.ask()}get widest(){return LONGEST_STEP2*this.answers.data.scene}onto(plane,point2){const map=this.
family,{poses,scene}=this.answers.data;if(!map||!this.box.checked)return null;const near2=nearestOnCurve(plane==="F"?map.fixed:map.moving,map.loops,point2,this.
widest);return near2?ontoCurve(poses,plane,near2.at,scene):point2}draw(){const map=this.family,on=Boolean(map)&&this.box.checked;put(this.group,"visibility",on?
"visible":"hidden");give(this.legend,"hidden",!on);if(!on)return;const{view}=this.scene,planes=[[map.fixed,view.X,view.Y],[map.moving,x=>view.scale*x,y=>-view.scale*
y]];planes.forEach(([points,X,Y],n)=>{const paths=curvePaths(points,map.loops,map.worth,X,Y,this.widest);[...this.curves[n].children].forEach((path2,k)=>put(path2,
"d",paths[STROKES[k]]))});this.move()}move(){const{view}=this.scene,place=this.playing.here?.place;if(place&&this.family)put(this.curves[1],"transform",transform(
view.X(place.x),view.Y(place.y),place.a))}};var MAX_BANDS=12;var PivotMap=class{view;constructor(data,parent){this.data=data;this.parent=parent;this.canvas=h("canvas",{"aria-hidden":"true"});const name=`b\
m-map-${Math.random().toString(36).slice(2)}`;this.svg=s("svg",{class:"bm-map-picture",role:"application",tabindex:"0","aria-roledescription":"map","aria-descri\
bedby":name,"aria-label":"Pivot map: the error of the best link for every fixed pivot. Arrow keys move a cursor, with Shift by ten steps; the error there is tol\
d."});this.readout=h("output",{class:"bm-readout",id:name});this.cursor=null;this.legend=h("p",{class:"bm-legend"});parent.append(h("div",{class:"bm-map"},this.
canvas,this.svg),this.legend,this.readout);this.svg.addEventListener("pointermove",event=>this.read(event));this.svg.addEventListener("pointerleave",()=>this.tell());
this.svg.addEventListener("keydown",event=>this.move(event));const{log10_rms:levels}=data.pivot_map;const known=levels.filter(level=>level!==null).sort((a,b)=>a-
b);const low=known[Math.floor(.002*known.length)],high=known[Math.floor(.98*known.length)];this.step=[1/24,1/12,1/6,1/3,1/2,1,2].find(step=>(high-low)/step<MAX_BANDS-
1)??3;this.low=Math.floor(low/this.step)*this.step;this.high=Math.ceil(high/this.step)*this.step;this.count=Math.max(1,Math.round((this.high-this.low)/this.step));
this.invitation="Point at the map to read it, or move over it by arrow keys.";this.readout.append(this.invitation)}level(u,v){const{columns,rows,log10_rms:levels}=this.
data.pivot_map;const i=clamp(Math.floor(u),0,columns-2),j=clamp(Math.floor(v),0,rows-2);const a=u-i,b=v-j,at=j*columns+i;const[p,q,r,t]=[levels[at],levels[at+1],
levels[at+columns],levels[at+columns+1]];const shares=[(1-a)*(1-b),a*(1-b),(1-a)*b,a*b];if([p,q,r,t].some((level,k)=>level===null&&shares[k]>0))return null;return shares[0]*
p+shares[1]*q+shares[2]*r+shares[3]*t}build(linkage){const{svg}=this,map=this.data.pivot_map;const width=Math.max(240,this.parent.clientWidth);const height=Math.
round(width*(map.high[1]-map.low[1])/(map.high[0]-map.low[0]));this.paint(width,height);svg.setAttribute("viewBox",`0 0 ${width} ${height}`);svg.replaceChildren();
const scale=width/(map.high[0]-map.low[0]);const view={width,height,X:x=>(x-map.low[0])*scale,Y:y=>height-(y-map.low[1])*scale};this.linkage=linkage;this.view=view;
this.explain(this.pivots(linkage,view));this.mark=s("path",{class:"bm-map-cursor",d:"M-11 0H-4M4 0H11M0 -11V-4M0 4V11"});svg.append(this.mark);this.tell()}paint(width,height){
const{canvas}=this,map=this.data.pivot_map;const dense=Math.min(2,window.devicePixelRatio||1);const style=getComputedStyle(this.parent);const near2=rgb(style.getPropertyValue(
"--bm-map-near"));const far=rgb(style.getPropertyValue("--bm-map-far"));const w=Math.round(width*dense),t=Math.round(height*dense);if(canvas.width===w&&this.paintedIn===
near2.join())return;this.paintedIn=near2.join();canvas.width=w;canvas.height=t;const context=canvas.getContext("2d"),image=context.createImageData(w,t);const band=new Int16Array(
w*t);for(let j=0;j<t;j+=1){for(let i=0;i<w;i+=1){const level=this.level(i/(w-1)*(map.columns-1),(1-j/(t-1))*(map.rows-1));band[j*w+i]=level===null?-1:clamp(Math.
floor((level-this.low)/this.step),0,this.count-1)}}for(let k=0;k<w*t;k+=1){const own=band[k];const edge=k%w&&band[k-1]!==own||k>=w&&band[k-w]!==own;const share=own<
0?1:own/Math.max(1,this.count-1);const shade=edge?.84:1;for(let c=0;c<3;c+=1)image.data[4*k+c]=shade*(near2[c]+share*(far[c]-near2[c]));image.data[4*k+3]=255}context.
putImageData(image,0,0)}pivots(linkage,view){const{data,svg}=this,map=data.pivot_map;const labels=new Labels(view);for(const pose of data.poses){const x=px(view.
X(pose.x)),y=px(view.Y(pose.y));svg.append(s("path",{class:"bm-cross",d:`M${x-3} ${y}h6M${x} ${y-3}v6`}))}const every=new Map;for(const each of data.linkages)for(const dyad of each.
led)if(dyad.fixed_pivot)every.set(dyad.fixed_pivot.join(),dyad);for(const dyad of data.dyads)if(dyad.fixed_pivot)every.set(dyad.fixed_pivot.join(),dyad);const inside2=([
x,y])=>x>=map.low[0]&&x<=map.high[0]&&y>=map.low[1]&&y<=map.high[1];for(const dyad of every.values()){if(!inside2(dyad.fixed_pivot))continue;const[x,y]=[view.X(
dyad.fixed_pivot[0]),view.Y(dyad.fixed_pivot[1])];svg.append(s("circle",{class:"bm-some-pivot",cx:px(x),cy:px(y),r:2.5}))}const outside=[];(linkage?.led??[]).forEach(
(dyad,side)=>{if(!dyad.fixed_pivot)return;if(!inside2(dyad.fixed_pivot)){outside.push(`the fixed pivot of ${dyad.id} lies outside`);return}const[x,y]=[view.X(dyad.
fixed_pivot[0]),view.Y(dyad.fixed_pivot[1])];labels.block(x,y,12,12);svg.append(s("circle",{class:`bm-its-pivot bm-side${side}`,cx:px(x),cy:px(y),r:6}),labels.put(
x,y,dyad.id,16,{class:"bm-map-name"}))});return outside}explain(outside){const unit2=this.data.unit?` ${this.data.unit}`:"";this.legend.replaceChildren(h("span",
{class:"bm-swatch bm-near"}),` ${figure(10**this.low)}${unit2} or less`,h("span",{class:"bm-swatch bm-far"}),` ${figure(10**this.high)}${unit2} or more; each li\
ne is a factor of ${figure(10**this.step)}. `,"Small dots: fixed pivots of all dyads; crosses: the poses.",outside.length?` Of this linkage, ${listed(outside)}.`:
"")}placeAt([u,v]){const{low,high,columns,rows}=this.data.pivot_map;return[low[0]+u/(columns-1)*(high[0]-low[0]),low[1]+v/(rows-1)*(high[1]-low[1])]}move(event){
const step={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowDown:[0,-1],ArrowUp:[0,1]}[event.key];if(!step||event.ctrlKey||event.metaKey||event.altKey)return;event.preventDefault();
const{low,high,columns,rows}=this.data.pivot_map,many=event.shiftKey?10:1;const pivot=this.linkage?.led.map(dyad=>dyad.fixed_pivot).find(Boolean)??this.placeAt(
[(columns-1)/2,(rows-1)/2]);const[u,v]=this.cursor??[Math.round((pivot[0]-low[0])/(high[0]-low[0])*(columns-1)),Math.round((pivot[1]-low[1])/(high[1]-low[1])*(rows-
1))];this.cursor=[clamp(u+many*step[0],0,columns-1),clamp(v+many*step[1],0,rows-1)];this.tell()}tell(){const{cursor,mark,view}=this;mark?.setAttribute("visibili\
ty",cursor?"visible":"hidden");if(!cursor){this.readout.textContent=this.invitation;return}const[x,y]=this.placeAt(cursor);mark?.setAttribute("transform",`trans\
late(${px(view.X(x))} ${px(view.Y(y))})`);this.say(cursor)}read(event){const box=this.svg.getBoundingClientRect(),{columns,rows}=this.data.pivot_map;this.say([(event.
clientX-box.left)/box.width*(columns-1),(1-(event.clientY-box.top)/box.height)*(rows-1)])}say(at){const[x,y]=this.placeAt(at),level=this.level(...at);const digits=Math.
max(0,2-Math.floor(Math.log10(this.data.scene)));const unit2=this.data.unit?` ${this.data.unit}`:"";this.readout.textContent=`Fixed pivot (${fixed(x,digits)}, ${fixed(
y,digits)}): the best link misses by `+(level===null?"an unknown error.":`${figure(10**level)}${unit2} (rms).`)}};var GRASP=26;var STILL=3;var PivotMapPanel=class{map;constructor(answers,playing,hand){this.answers=answers;this.playing=playing;this.hand=hand;this.map=null;this.
handles=null;this.element=h("div",{class:"bm-fill"});this.pace=new Pace(()=>this.build(),()=>isSeen(this.element));playing.on("shape",()=>this.pace.ask());new ResizeObserver(
()=>this.pace.ask()).observe(this.element);watch(this.element,()=>this.pace.ask())}renew(){const{data}=this.answers;if(this.shown===data.pivot_map)return;this.shown=
data.pivot_map;this.element.replaceChildren();this.map=data.pivot_map?new PivotMap(data,this.element):null;if(this.map)this.listen();this.pace.ask()}build(){if(!this.
map)return;this.map.build(this.answers.shown);this.handles=[0,1].map(k=>s("g",{class:`bs-pivot bs-map-pivot bm-side${k}`},s("circle",{class:"bs-pivot-ring",r:8})));
this.map.svg.append(...this.handles);this.drawHandles()}drawHandles(){if(!this.handles||!this.map?.view)return;const{view}=this.map;this.handles.forEach((element,k)=>{
const pivot=this.hand.pivot(k,"F");put(element,"display",pivot?"inline":"none");if(!pivot)return;put(element,"transform",`translate(${px(view.X(pivot.at[0]))} ${px(
view.Y(pivot.at[1]))})`);element.dataset.mapPivot=pivot.id})}nearest([x,y]){const{view}=this.map;const away=[0,1].map(k2=>{const pivot=this.hand.pivot(k2,"F");return pivot?
Math.hypot(view.X(pivot.at[0])-view.X(x),view.Y(pivot.at[1])-view.Y(y)):Infinity});const k=away[1]<away[0]?1:0;return{k,away:away[k]}}listen(){const{hand}=this,
{svg}=this.map;const at=event=>{const box=svg.getBoundingClientRect(),{low,high}=this.answers.data.pivot_map;const u=(event.clientX-box.left)/box.width,v=1-(event.
clientY-box.top)/box.height;return[low[0]+u*(high[0]-low[0]),low[1]+v*(high[1]-low[1])]};let pointer=null,start=null;const end=event=>{if(event.pointerId!==pointer)
return;pointer=null;hand.drop()};svg.addEventListener("pointerdown",event=>{if(event.button!==0)return;const point2=at(event),{k,away}=this.nearest(point2);if(!Number.
isFinite(away)||!hand.take(k,"F"))return;event.preventDefault();pointer=event.pointerId;start={near:away<=GRASP,X:event.clientX,Y:event.clientY};svg.setPointerCapture(
pointer);this.playing.player.play(false);if(!start.near)hand.put(point2)});svg.addEventListener("pointermove",event=>{if(event.pointerId!==pointer)return;if(start.
near&&Math.hypot(event.clientX-start.X,event.clientY-start.Y)<STILL)return;start.near=false;hand.put(at(event))});svg.addEventListener("pointerup",end);svg.addEventListener(
"pointercancel",end);svg.addEventListener("keydown",event=>{if(event.key==="Escape"&&hand.pivots)hand.release();if(event.key!=="Enter"||!this.map.cursor)return;
const point2=this.map.placeAt(this.map.cursor),{k}=this.nearest(point2);if(!hand.take(k,"F"))return;event.preventDefault();hand.put(point2);hand.drop()})}};var ARROWS4={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]};var PivotSurface=class{held;constructor(store,answers,playing,scene){this.store=store;
this.answers=answers;this.playing=playing;this.scene=scene;this.pivots=null;this.held=null;this.handles=s("g",{class:"bs-pivots"});scene.layer("pivots").append(
this.handles);this.parts=[0,1].map(k=>["F","M"].map(plane=>this.handle(k,plane)));this.story=h("p",{class:"bm-story"});this.readout=h("output",{class:"bs-placed\
-readout","aria-live":"polite"});this.letGo=h("button",{type:"button",class:"bs-small",hidden:true,onclick:()=>this.release()},"Let go of the pivots");this.curves=
new FamilyCurves(store,answers,playing,scene);this.map=new PivotMapPanel(answers,playing,this);this.element=h("div",{class:"bs-surface"},this.story,h("div",{class:"\
bs-tool"},this.curves.label),this.curves.legend,this.map.element,this.readout,h("div",{class:"bs-tool"},this.letGo));answers.on("answers",()=>this.renew());answers.
on("poses",()=>{this.explain();if(this.pivots)store.place(this.pivots)});answers.on("placed",()=>this.tell());playing.on("shape",()=>this.show());playing.on("pl\
ace",()=>this.move());scene.on("view",()=>this.show());store.on("state document",()=>this.element.classList.toggle("bs-stale",answers.isOld));this.renew()}get dyads(){
if(this.store.document.poses.some(isPoint2))return[];const placed=this.store.placed?.dyads;if(this.pivots&&placed?.length)return placed;return this.answers.shown?.
led??[]}pivot(k,plane){const dyad=this.dyads[k];if(!dyad)return null;const wanted=this.pivots?.[k];const at=wanted?.plane===plane?wanted.at:plane==="F"?dyad.fixed_pivot:
dyad.moving_pivot;return at?{plane,at,id:dyad.id}:null}handle(k,plane){const name=plane==="F"?"fixed":"moving";const element=s("g",{class:`bs-pivot bs-pivot-${name}\
 bm-side${k}`,"data-plane":plane,tabindex:0,role:"button"},s("circle",{class:"bs-hold",r:13}),s("circle",{class:"bs-pivot-ring",r:8}));let before;this.scene.drag?.(
element,{start:()=>{before=this.pivots;this.playing.player.play(false);this.place=this.playing.here?.place??null;return this.take(k,plane)},move:({x,y})=>this.put(
plane==="F"?[x,y]:back(this.place,[x,y])),end:()=>this.drop(),cancel:()=>{this.drop();if(before)this.ask(before);else this.release()}});element.addEventListener(
"keydown",event=>this.key(event,k,plane));this.handles.append(element);return element}key(event,k,plane){if(event.ctrlKey||event.metaKey)return;const arrow2=ARROWS4[event.
key];if(event.key==="Escape"&&this.pivots){this.release()}else if(arrow2){const{at}=this.pivot(k,plane),step=(this.scene.step??this.answers.data.scene/100)*(event.
shiftKey?10:event.altKey?.1:1);if(!this.take(k,plane))return;this.put(at.map((value,axis)=>value+step*arrow2[axis]),step);this.drop()}else{return}event.preventDefault()}take(k,plane){
const start=this.pivot(k,plane);if(!start||plane==="M"&&!this.playing.here)return false;const other=this.pivots?.[1-k]??this.pivot(1-k,"F")??this.pivot(1-k,"M");
const next=[];next[k]={plane,at:start.at};if(other)next[1-k]={plane:other.plane,at:other.at};this.pivots=next;this.held={k,plane};this.keepHeight();return true}keepHeight(){
const{element}=this.playing;element.style.minHeight=`${element.offsetHeight}px`}put(point2,step=0){const{k,plane}=this.held,digits=decimalsOf(this.answers.data);
let at=this.curves.onto(plane,point2);if(!at)at=point2.map(value=>step?Number(value.toFixed(digits)):this.scene.rounded(value));this.ask(this.pivots.map((each,n)=>n===
k?{plane,at}:each))}drop(){this.held=null}ask(pivots){this.pivots=pivots;this.store.place(pivots.map(({plane,at})=>({plane,at})));this.show();this.tell()}release(){
this.pivots=null;this.held=null;this.playing.element.style.minHeight="";this.store.place([]);if(this.store.chosen===PLACED)this.store.choose(this.before??this.answers.
linkages[0]?.id??null);this.tell();this.show()}renew(){const{data}=this.answers;if(!this.pivots&&this.store.chosen!==PLACED)this.before=this.store.chosen;this.curves.
renew();this.map.renew();this.explain();this.show()}explain(){const count=this.answers.data.poses.length;const text=count===4&&this.curves.family?"Four poses le\
ave a curve of dyads. Drag a pivot in the drawing: it slides along its curve.":count===3?"Three poses leave every pivot free. Drag a fixed pivot anywhere in F, \
or a moving pivot anywhere on the body.":count===2?"Two poses leave much open. Drag a pivot: its best dyad follows.":"Drag a pivot in the drawing or on the map:\
 the best dyad there is shown with what it costs.";say(this.story,text)}show(){const{view}=this.scene,place=this.playing.here?.place,there2=this.answers.shown&&
!this.answers.shown.gone;this.parts.forEach((planes,k)=>{planes.forEach((element,n)=>{const plane="FM"[n],pivot=there2||this.pivots?this.pivot(k,plane):null;const seen2=pivot&&
(plane==="F"||place);put(element,"display",seen2?"inline":"none");if(!seen2)return;put(element,"data-pivot",pivot.id);element.classList.toggle("bs-put",this.pivots?.[k]?.
plane===plane);if(plane==="F")put(element,"transform",`translate(${px(view.X(pivot.at[0]))} ${px(view.Y(pivot.at[1]))})`)})});this.name();this.move();this.map.drawHandles()}move(){
const{view}=this.scene,place=this.playing.here?.place;if(!place)return;this.parts.forEach(([,element],k)=>{const pivot=element.getAttribute("display")==="none"?
null:this.pivot(k,"M");if(!pivot)return;const[x,y]=act(this.held?.k===k&&this.held.plane==="M"&&this.place?this.place:place,pivot.at);put(element,"transform",`t\
ranslate(${px(view.X(x))} ${px(view.Y(y))})`)})}name(){if(this.held||this.store.state==="dragging")return;const digits=decimalsOf(this.answers.data);this.parts.
forEach((planes,k)=>planes.forEach((element,n)=>{const pivot=this.pivot(k,"FM"[n]);if(!pivot)return;const text=`${n?"Moving":"Fixed"} pivot of ${pivot.id} at (${pivot.
at.map(value=>fixed(value,digits)).join(", ")}) in ${"FM"[n]}. Drag it, or use the arrow keys; the best dyad there is shown.`;put(element,"aria-label",text)}))}tell(){
const{store,answers}=this,{placed}=store;give(this.letGo,"hidden",!this.pivots);if(!this.pivots||!placed){say(this.readout,"");if(!placed&&this.pivots&&!this.held&&
store.placeWanted===null)this.pivots=null;return}put(this.readout,"aria-live",this.held?"off":"polite");say(this.readout,placedInWords(placed,answers.data));if(placed.
linkage&&store.chosen!==PLACED&&this.pivots){this.before=store.chosen;store.choose(PLACED)}this.show()}};function placedInWords(placed,data){const unit2=data.unit?
` ${data.unit}`:"",digits=decimalsOf(data);const miss=value=>value===null?"an unknown error":value<1e-9*data.scene?"nothing":`${figure(value)}${unit2}`;const dyads=placed.
dyads.map(dyad=>`${dyad.id}: fixed pivot (${dyad.fixed_pivot.map(v=>fixed(v,digits)).join(", ")}), moving pivot (${dyad.moving_pivot.map(v=>fixed(v,digits)).join(
", ")}), misses by ${miss(dyad.max_error)} at most.`);const{linkage}=placed;if(!linkage)return[...dyads,...(placed.messages??[]).map(({message})=>`${message[0].
toUpperCase()}${message.slice(1)}.`)].join(" ");const both=linkage.usable?`usable, ${linkage.said.met}`:`not usable: ${linkage.said.reasons.join("; ")}`;return`${dyads.
join(" ")} Together a ${linkage.type}: ${both}.`}var Assemblies=class{constructor(data,take){this.data=data;this.take=take;this.name=`bm-way-${Math.random().toString(36).slice(2)}`;this.element=h("fieldset",{class:"\
bm-ways"})}build(linkage,index){const one=(way,k)=>h("label",{},h("input",{type:"radio",name:this.name,value:k,checked:k===index,onchange:()=>this.take(k)}),h("\
span",{},h("b",{},wayName(way,linkage).replace("assembly ","")),` ${wayStory(way,this.data.poses)}`));this.element.replaceChildren(h("legend",{},"Assembly"),...linkage.
ways.map(one));give(this.element,"hidden",!linkage.ways.length||Boolean(this.data.whole))}};var TURN_SECONDS=7;var TURN=1e-6;var NAME_ROWS=5;var NUMBER_ROWS=2;var MANY_POSES2=100;var ROW=13;var LONGEST_TICK=18;var NO_ERROR2=1e-7;var STEPS=360;var SPEEDS=[
.25,.5,1,2,4];var LOOPS=[["back","there and back"],["again","again and again"],["once","once"]];var Player=class{parts;steps;tick;wholeLabel;speeds;loops;real;realLabel;constructor(data,show,rebuild){
this.data=data;this.draw={show,rebuild};this.linkage=null;this.way=0;this.u=0;this.heading=1;this.speed=1;this.loop="back";this.isReal=false;this.whole=false;this.
stretch={low:0,high:1,sense:1};this.playing=false;this.remaining=null;this.element=this.controls()}get path(){return this.linkage?.ways[this.way]}get stop(){return nounOf(
this.data)}controls(){const button2=(name,text,label,onclick)=>h("button",{type:"button",class:`bm-button ${name}`,"aria-label":label,title:label,onclick},text);
this.button=button2("bm-play","","Play",()=>this.play(!this.playing));this.slider=h("input",{type:"range",class:"bm-slider",min:0,step:"any","aria-label":"Drive\
r",oninput:()=>this.go(this.turned(Number(this.slider.value)))});this.box=h("input",{type:"checkbox",onchange:()=>this.playWhole(this.box.checked)});this.boxName=
h("span",{},"Whole branch");this.stops=s("svg",{class:"bm-stops","aria-hidden":"true"});this.parts=["","","",""].map(text=>h("span",{},text));this.readout=h("ou\
tput",{class:"bm-now"},this.parts.flatMap((part,k)=>k?[" ",part]:[part]));this.slider.addEventListener("keydown",event=>{const step={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,
ArrowUp:1}[event.key];if(!step)return;event.preventDefault();this.step(event.shiftKey?10*step:step)});const choice2=(label,entries,take)=>h("select",{class:"bm-\
pick","aria-label":label,title:label,onchange:event=>take(event.target.value)},entries.map(([value,text])=>h("option",{value},text)));this.steps=[button2("bm-ba\
ck","","",()=>this.toPose(-1)),button2("bm-next","","",()=>this.toPose(1))];this.speeds=choice2("Speed",SPEEDS.map(each=>[each,`${each} ×`]),value=>this.speed=
Number(value));this.speeds.value="1";this.loops=choice2("What comes after the last pose",LOOPS,value=>this.takeLoop(value));this.real=h("input",{type:"checkbox",
onchange:()=>this.isReal=this.real.checked});this.realLabel=h("label",{class:"bm-real",hidden:true,title:"Move as the drive of the task moves it"},this.real,h("\
span",{},"As driven"));this.wholeLabel=h("label",{class:"bm-whole"},this.box,this.boxName);this.nameStops();return h("div",{class:"bm-controls"},h("div",{class:"\
bm-track"},this.slider,this.stops),h("div",{class:"bm-row"},this.button,this.steps[0],button2("bm-small-step","‹","A small step back",()=>this.step(-1)),button2(
"bm-small-step","›","A small step on",()=>this.step(1)),this.steps[1],this.speeds,this.loops,this.wholeLabel,this.realLabel),this.readout)}nameStops(){const{stop}=this,
title=stop[0].toUpperCase()+stop.slice(1);[[`◀ ${title}`,`Previous ${stop}`],[`${title} ▶`,`Next ${stop}`]].forEach(([text,label],k)=>{say(this.steps[k],text);
put(this.steps[k],"aria-label",label);give(this.steps[k],"title",label)});give(this.wholeLabel,"title",`Play all that the driver reaches, not only from the firs\
t ${stop} to the last`)}load(linkage){this.linkage=linkage;const counts=linkage.ways.map(way=>way.poses.length);this.take(Math.max(0,counts.indexOf(Math.max(...counts))))}take(index){
this.way=index;this.u=this.firstStop();this.draw.rebuild()}get stopsOnWay(){return this.linkage.pose_errors.map((row,k)=>({...row,k})).filter(row=>row.way===this.
way)}firstStop(){return this.stopsOnWay[0]?.frame??0}rebuild(){const{path:path2,slider}=this;if(!path2)this.play(false);this.nameStops();for(const each of[slider,
this.button])give(each,"disabled",!path2);if(this.linkage)this.stretch=stretchOf(this.linkage,this.way,this.whole);give(this.box,"disabled",!this.stretch.isApart);
give(this.realLabel,"hidden",!this.timed);say(this.boxName,path2?.round?"Whole turn":"Whole branch");this.heading=1;this.u=clamp(this.u,this.stretch.low,this.stretch.
high)}playWhole(on){this.whole=on;this.draw.rebuild()}drawStops(){const{stops,path:path2}=this,{low,high}=this.stretch;stops.replaceChildren();if(!path2)return;
const width=Math.max(60,this.slider.clientWidth),inset=9;const X=u=>inset+(this.turned(u)-low)/(high-low)*(width-2*inset);const known=this.stopsOnWay.filter(row=>this.
data.poses[row.k]);const rows=known.sort((a,b)=>X(a.frame)-X(b.frame)).map(row=>({...row,x:X(row.frame),pose:this.data.poses[row.k]}));const named=laidOut(rows.
map(({x,pose})=>({x,text:shortened(poseName(pose),LONGEST_TICK)})),width,NAME_ROWS);const texts=named.every(({at})=>at>=0)?named:laidOut(rows.map(({x,pose})=>({
x,text:pose.label})),width,rows.length>MANY_POSES2?1:NUMBER_ROWS);const deepest=Math.max(0,...texts.map(({at})=>at));const one=(k,pose,...parts)=>s("g",{"data-p\
ose":k+1},s("title",{},calledOf(pose)),...parts);rows.forEach(({k,x,pose},i)=>stops.append(one(k,pose,s("path",{d:`M${px(x)} 0V${4+ROW*Math.max(0,texts[i].at)}`}))));
rows.forEach(({k,pose},i)=>{const{at,middle:middle2,text}=texts[i];if(at>=0)stops.append(one(k,pose,s("text",{x:px(middle2),y:14+ROW*at,"text-anchor":"middle"},
text)))});put(stops,"viewBox",`0 0 ${width} ${16+ROW*deepest}`);put(stops,"height",16+ROW*deepest)}play(on){if(on&&!this.path)return;this.remaining=null;if(on===
this.playing&&this.isDressed)return;this.isDressed=true;this.playing=on;put(this.readout,"aria-live",on?"off":"polite");this.button.replaceChildren(icon(on),on?
"Pause":"Play");put(this.button,"aria-label",on?"Pause":"Play");this.button.title=on?"Pause (space)":"Play (space)";cancelAnimationFrame(this.tick);if(!on)return;
let before=null;const run=now=>{if(!this.playing)return;if(before!==null)this.advance(Math.min(.1,(now-before)/1e3));before=now;if(this.playing)this.tick=requestAnimationFrame(
run)};this.tick=requestAnimationFrame(run)}playOnce(){if(!this.path)return;const{low,high}=this.stretch;this.u=this.turned(low);this.heading=1;this.play(true);this.
remaining=(this.goesRound?1:2)*(high-low)}get goesRound(){return this.path.round&&this.stretch.high-this.stretch.low>this.path.x.length-1-TURN}turned(u){const{low,
high,sense}=this.stretch;return sense<0?low+high-u:u}get timed(){const loads=this.linkage?.followed?null:this.linkage?.loads;return loads?.way===this.way&&!this.
whole?loads.timed:null}takeLoop(loop){this.loop=loop;this.heading=1}advance(seconds){const{low,high}=this.stretch;if(this.isReal&&this.timed)return this.drive(seconds);
const step=this.speed*seconds*(high-low)/(this.goesRound?TURN_SECONDS:TURN_SECONDS/2);if(this.remaining!==null){this.remaining-=step;if(this.remaining<=0){this.
play(false);this.u=this.firstStop();this.show();return}}const at=this.turned(this.u)+this.heading*step,isOver=at>=high;if(isOver&&this.loop==="once"){this.play(
false);this.u=this.turned(high)}else if(this.goesRound){this.u=this.turned(around2(at,high))}else if(isOver&&this.loop==="again"){this.u=this.turned(low)}else{if(isOver||
at<=low)this.heading=isOver?-1:1;this.u=this.turned(clamp(at,low,high))}this.show()}drive(seconds){const{timed}=this,{y}=timed.time,last=Math.max(y[0],y[y.length-
1]),here=valueAt(timed.time,linear(this.path.drive,this.u))??0;let time=here+this.speed*seconds;if(time>=last&&here<last)time=last;else if(time>=last&&this.loop===
"once")return this.play(false);else if(time>=last)time=0;this.u=frameAt(this.path.drive,driveAtTime(timed,time)??linear(this.path.drive,this.u)??0);this.show()}step(steps){
if(!this.path)return;const{low,high}=this.stretch;const at=this.turned(this.u)+steps*Math.max(.001,(high-low)/STEPS);this.go(this.turned(this.goesRound?around2(
at,high):at))}go(u){if(!this.path)return;this.play(false);this.u=clamp(u,this.stretch.low,this.stretch.high);this.show()}toPose(sense){const all=this.linkage.pose_errors.
map((row,k)=>({...row,k})).filter(row=>row.way!==null);if(!all.length)return;const here=this.atPose??(sense>0?-1:this.data.poses.length);const next=sense>0?all.
find(row=>row.k>here)??all[0]:[...all].reverse().find(row=>row.k<here)??all[all.length-1];this.play(false);if(next.way!==this.way){this.way=next.way;this.u=next.
frame;this.draw.rebuild()}this.go(next.frame);this.atPose=next.k}placeAt(u){return placeAt(this.linkage,this.path,u,this.data.chart.length)}nearest(place){let near2=0,
least2=Infinity;this.data.poses.forEach((pose,k)=>{const turn=pose.angle_deg===null?0:place.a-radians(pose.angle_deg);const away=Math.hypot(place.x-pose.x,place.
y-pose.y,this.data.chart.length*(turn-2*Math.PI*Math.round(turn/(2*Math.PI))));if(away<least2)[near2,least2]=[k,away]});return near2}show(told=true){const{path:path2}=this;
if(!path2){for(const part of this.parts)part.textContent="";return}const place=this.placeAt(this.u);const drive=linear(path2.drive,this.u),transmission=linear(path2.
transmission,this.u);const near2=this.atPose=this.nearest(place);if(told){give(this.slider,"min",this.stretch.low);give(this.slider,"max",this.stretch.high);give(
this.slider,"value",this.turned(this.u));this.tell(place,drive,transmission,near2)}this.draw.show(place,drive,transmission,near2)}driverText(drive){const{data,linkage}=this;
return linkage.led[0].kind==="PR"?`${fixed(drive,decimalsOf(data))}${data.unit?` ${data.unit}`:""}`:`${linkage.crank??""}${fixed(drive,1)}°`}tell(place,drive,transmission,near2){
const{data,linkage}=this;const unit2=data.unit?` ${data.unit}`:"",digits=decimalsOf(data),driver=this.driverText(drive);const pose=data.poses[near2],row=linkage.
pose_errors[near2];const at=row?.at===this.path&&Math.abs(row.frame-this.u)<1e-6;const away=()=>`${figure(Math.hypot(place.x-pose.x,place.y-pose.y))}${unit2} fr\
om ${calledOf(pose)}`;const missed2=()=>`at ${calledOf(pose)}, ${row.said.position==="exact"?"":"off by "}${missOf(row.said.position,row.said.turned,unit2)}`;const said=!pose?
"between the poses":pose.called?`${at?"at":"near"} ${pose.called}`:at?missed2():away();const time=this.isReal&&this.timed&&drive!==null?valueAt(this.timed.time,
drive):null;const known=this.path.told?.map(each=>this.toldOf(each))??[`driver ${driver}${time===null?"":` at ${fixed(time,2)} s`}`,`body (${fixed(place.x,digits)}\
, ${fixed(place.y,digits)})${unit2}, ${fixed(((degrees(place.a)+180)%360+360)%360-180,2)}°`];const texts=[...known,`transmission ${transmission===null?"–":`${fixed(
transmission,1)}°`}`,said];texts.forEach((text,k)=>{const whole=k+1<texts.length?`${text} ·`:text;if(this.parts[k].textContent!==whole)this.parts[k].textContent=
whole});put(this.slider,"aria-valuetext",`${texts[0]}, ${texts[3]}`)}toldOf({name,digits,values,panel}){const error=panel===void 0?null:valueAt(this.linkage.panels[panel],
smooth(this.path.drive,this.u));const off=error===null?"":`, off by ${Math.abs(error)<NO_ERROR2?"0":figure(error)}°`;return`${name} ${fixed(smooth(values,this.
u),digits)}°${off}`}};function laidOut(texts,width,count){const ends=Array(count).fill(-99);return texts.map(({x,text})=>{const size2=6.4*text.length,left=clamp(
x-size2/2,0,Math.max(0,width-size2));const at=ends.findIndex(end=>left>end+4);if(at>=0)ends[at]=left+size2;return{text,at,middle:left+size2/2}})}var around2=(u,turn)=>(u%
turn+turn)%turn;function icon(pause){return s("svg",{width:12,height:12,viewBox:"0 0 12 12","aria-hidden":"true"},s("path",{d:pause?"M1 0h3.5v12H1zM7.5 0H11v12H\
7.5z":"M1 0l11 6l-11 6z"}))}var APART2=3;var GOLDEN=.381966011250105;var HALVINGS=24;function drivenByOther(linkage,length){const led=[linkage.led[1],linkage.led[0]];if(led[0].kind==="PP"||
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
(v,k)=>v-at(other,j)[k]));return away<=APART2*step+1e-9*Math.hypot(...at(one,i))}function piecesOf(linkage,driver,{circuit,closed:closed2,stations},length){const placeOf2=({
way,u})=>placeAt(linkage,linkage.ways[way],u,length);const slides=driver.kind==="PR";let before=null;const driveAt=station=>{let drive=driveOf(driver,placeOf2(station));
if(!slides&&before!==null)drive-=2*Math.PI*Math.round((drive-before)/(2*Math.PI));return drive};const drives=stations.map(station=>before=driveAt(station));const count=stations.
length-1,sense=k=>Math.sign(drives[k+1]-drives[k]);const cuts=[];for(let k=1;k<count;k+=1)if(sense(k)*sense(k-1)<0)cuts.push(k);if(closed2&&sense(0)*sense(count-
1)<0)cuts.push(0);if(!cuts.length)return[{circuit,round:closed2,dead:[false,false],stations}];const dead=new Map(cuts.map(k=>[k,extreme(k)]));function extreme(k){
const here=stations[k],up=drives[k]>drives[k===0?1:k-1]?1:-1;before=drives[k];const sides=[k>0?k-1:count-1,k+1].map(at2=>{const there2=stations[at2];if(there2.way===
here.way&&Math.abs(there2.u-here.u)<1.5)return[here.way,here.u,there2.u];return[there2.way,there2.u,there2.u<1.5?0:there2.u+1]});const value=(way,u)=>up*driveAt(
{way,u});let best={station:here,value:value(here.way,here.u)};for(const[way,u,v]of sides){let[low,high]=[Math.min(u,v),Math.max(u,v)];for(let step=0;step<HALVINGS;step+=
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
build(this.linkage,player.way);this.buildDrivers();this.emit("shape",false);this.marks.ask();player.show()}placed(here){this.here=here;const{path:path2,u}=this.
player;const pose=this.linkage.pose_errors.findIndex(row=>row.at===path2&&Math.abs(row.frame-u)<AT_POSE);this.at={drive:here.drive,pose:pose<0?void 0:pose};this.
emit("place",here)}goToSelected(){const{selection}=this.store,{player}=this;if(selection?.kind!=="pose"||player.playing)return;const row=this.linkage?.pose_errors[selection.
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
swers",()=>{if(first&&player.path){first=false;player.playOnce()}});store.on("document selection",()=>{first=false;if(player.remaining!==null)player.play(false)})}var ORDERS={rank:{name:"best first",of:linkage=>linkage.rank??Infinity},worst:{name:"worst miss",of:linkage=>linkage.worst??Infinity},least:{name:"transmission \
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
"hidden",!isPlaced);say(this.letGo,linkage.called==="By hand"?"Let go of the pivots":"Put it away");for(const button2 of[this.pin,this.compare,this.improve])labelled2(
button2,linkage.id)}tellBetter(sentences){this.better.replaceChildren(...sentences.map(sentence2=>h("li",{},sentence2)))}};function pastOf({was,shift,isNew,followed}){
if(isNew&&!was)return"new";const moved=shift&&!followed?`moved ${(100*shift).toFixed(1)} %`:"";return[was?`was ${was}`:"",moved].filter(Boolean).join(", ")}function least(linkage){
const angle=leastOf(linkage);return angle==="–"?angle:angle==="0°"?"down to 0°":`${angle} or more`}function setPressed(button2,on){put(button2,"aria-pressed",
Boolean(on))}function labelled2(button2,id){put(button2,"aria-label",`${button2.textContent}: ${id}`)}var MOST3=500;var History=class{constructor(){this.past=[];this.future=[]}record(value,gesture){this.future=[];const last=this.past.at(-1);if(gesture!==null&&last?.
gesture===gesture)return;this.past.push({value,gesture});if(this.past.length>MOST3)this.past.shift()}undo(value){const last=this.past.pop();if(!last)return null;
this.future.push(value);return last.value}redo(value){const next=this.future.pop();if(next===void 0)return null;this.past.push({value,gesture:null});return next}abandon(gesture){
if(this.past.at(-1)?.gesture!==gesture)return null;return this.past.pop()?.value}get canUndo(){return this.past.length>0}get canRedo(){return this.future.length>
0}};var REST2=150;var MOST_REST=1e3;var MOST_FLYING=1;var MOST_SHOWN=6;var FEWEST=2;var QUICK=1.2;var NO_ANSWER={linkages:[],dyads:[],best:[],warnings:[],pivot_map:null,
family_map:null,outcome:{message:"Two poses or more make a task"}};var PLACED2="placed";var kindOf=({poses,path:path2})=>`${poses.map(({free})=>free?.join("")??
"-").join()} ${path2?path2.closed:""}`;var Store=class{solving;placing;solved;constructor({connection,document:document2,options={},name="task",settings={},mostFlying=MOST_FLYING}){
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
kind&&selection?.index===this.selection?.index)return;this.selection=selection;this.emit("selection")}};var MOST4=40;var Results=class{constructor(store,answers){this.store=store;this.answers=answers;this.cards=new Map;this.wanted={order:"rank",filter:"all",type:""};
this.all=false;const choice2=(name,entries,key)=>h("label",{},`${name} `,h("select",{"data-choice":key,onchange:event=>this.want(key,event.target.value)},entries.
map(([value,text])=>h("option",{value},text))));this.types=choice2("Type",[["","any"]],"type");this.title=h("h2",{},"Linkages");this.status=h("p",{class:"bs-res\
ults-status",role:"status"});this.doubt=h("p",{class:"bs-doubt"});this.gone=h("p",{class:"bs-gone-note"});this.list=h("div",{class:"bs-cards"});this.more=h("but\
ton",{type:"button",class:"bs-small",hidden:true,onclick:()=>this.showAll()});this.element=h("section",{class:"bs-results","aria-label":"Linkages"},h("div",{class:"\
bs-results-head"},this.title,this.status,this.doubt,this.gone,h("div",{class:"bs-choices"},choice2("Show",Object.entries(FILTERS).map(([key,{name}])=>[key,name]),
"filter"),choice2("Sort by",Object.entries(ORDERS).map(([key,{name}])=>[key,name]),"order"),this.types)),this.list,this.more);this.pace=new Pace(()=>this.update());
this.list.addEventListener("keydown",event=>this.walk(event));answers.on("answers placed",()=>this.arrange());answers.on("moved",()=>this.pace.ask());answers.on(
"shown",()=>this.update());store.on("pinned",()=>this.arrange());store.on("state document",()=>this.tell());this.arrange()}want(key,value){this.wanted[key]=value;
this.arrange()}showAll(){this.all=true;this.arrange()}arrange(){const{answers,store,wanted}=this;this.buildTypes();const every=arranged(answers.linkages,{...wanted,
pinned:store.pinned});const shown2=this.all?every:every.slice(0,MOST4);const list=answers.placed?[answers.placed,...shown2]:shown2;const cards=new Map;for(const linkage of list)
cards.set(linkage,this.cards.get(linkage)??this.card());for(const[linkage,card]of this.cards)if(!cards.has(linkage))card.element.remove();this.cards=cards;let before=null;
for(const card of cards.values()){const next=before?before.nextSibling:this.list.firstChild;if(card.element!==next)this.list.insertBefore(card.element,next);before=
card.element}give(this.more,"hidden",every.length<=shown2.length);if(!this.more.hidden)say(this.more,`Show all ${every.length}`);this.hidden=answers.linkages.length-
every.length;this.update()}card(){const{store}=this;return new ResultCard({choose:id=>store.choose(id),pin:id=>store.pin(id),compare:id=>store.compare(id),improve:id=>this.
improve(id),letGo:()=>this.letGo()})}letGo(){if(this.store.placed?.cognateOf)this.store.letCognateGo();else this.store.place([]);if(this.store.chosen===PLACED)this.
store.choose(this.answers.linkages[0]?.id??null)}buildTypes(){const types=[...new Set(this.answers.linkages.map(each=>each.type))].sort(),key=types.join();const select=this.
types.querySelector("select");if(key===this.typesKey)return;this.typesKey=key;if(!types.includes(this.wanted.type))this.wanted.type="";select.replaceChildren(...[
"",...types].map(type=>h("option",{value:type,selected:type===this.wanted.type},type||"any")));give(this.types,"hidden",types.length<2)}update(){const{answers,store}=this,
{data,isOld,shown:shown2}=answers;for(const[linkage,card]of this.cards){card.show(linkage,{data,old:isOld&&linkage.id!==PLACED,chosen:linkage===shown2,pinned:store.
pinned.has(linkage.id),compared:store.compared===linkage.id})}this.tell()}tell(){const{answers,store}=this,there2=answers.linkages.filter(each=>!each.gone);const usable=there2.
filter(each=>each.usable).length;say(this.title,there2.length?`${there2.length} linkage${there2.length===1?"":"s"}, ${usable} usable`:store.solved?"No linkage":
"Linkages");put(this.status,"aria-live",store.state==="dragging"?"off":"polite");say(this.status,this.statusText());const uncertain=store.followed?.uncertain??[];
say(this.doubt,store.followed&&answers.isOld?uncertain.length?`May change when you let go: ${uncertain[0]}${/[.!]$/.test(uncertain[0])?"":"."}`:store.followed.complete===
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
replace(/^L\d+ changes/,"One changes");var sentence=text=>text?`${text[0].toUpperCase()}${text.slice(1)}.`:"";var WIDTH=440;var TURNING_SHARE=.35;function drawStill(canvas,scene,size2,turning){const share=turning?TURNING_SHARE:Math.min(1,WIDTH/size2.width);const width=Math.
round(size2.width*share),height=Math.round(size2.height*share);canvas.width=width;canvas.height=height;if(!scene.quadrics.length)return;const context=canvas.getContext(
"2d");if(!context)return;const image=context.createImageData(width,height);cast(image,scene);context.putImageData(image,0,0)}function cast(image,{eye,ahead,right,
up,reach,quadrics,paint,angles}){const{data,width,height}=image,[ex,ey,ez]=eye,[zc,zh,middleAngle,step]=angles;const lamp=unit(plus(plus(scaled(ahead,-1),scaled(
up,.5)),scaled(right,-.6)));const far=new Float64Array(4),which=new Uint8Array(4);for(let j=0;j<height;j+=1){const v=(1-(2*j+1)/height)*reach[1];for(let i=0;i<width;i+=
1){const u=((2*i+1)/width-1)*reach[0];let dx=ahead[0]+u*right[0]+v*up[0];let dy=ahead[1]+u*right[1]+v*up[1];let dz=ahead[2]+u*right[2]+v*up[2];const size2=1/Math.
sqrt(dx*dx+dy*dy+dz*dz);dx*=size2;dy*=size2;dz*=size2;const x1=(-1-ex)/dx,x2=(1-ex)/dx,y1=(-1-ey)/dy,y2=(1-ey)/dy;const z1=(-1-ez)/dz,z2=(1-ez)/dz;const enter=Math.
max(Math.min(x1,x2),Math.min(y1,y2),Math.min(z1,z2));const leave=Math.min(Math.max(x1,x2),Math.max(y1,y2),Math.max(z1,z2));if(!(enter<leave))continue;const middle2=(enter+
leave)/2,half=(leave-enter)/2;const ox=ex+middle2*dx,oy=ey+middle2*dy,oz=ez+middle2*dz;let count=0;for(let k=0;k<quadrics.length;k+=1){const c=quadrics[k];const cx=c[0]*
dx+c[1]*dy+c[2]*dz,cy=c[4]*dx+c[5]*dy+c[6]*dz;const cz=c[8]*dx+c[9]*dy+c[10]*dz,cw=c[12]*dx+c[13]*dy+c[14]*dz;const a=dx*cx+dy*cy+dz*cz,b=ox*cx+oy*cy+oz*cz+cw;const e=ox*
(c[0]*ox+2*(c[1]*oy+c[2]*oz+c[3]))+oy*(c[5]*oy+2*(c[6]*oz+c[7]))+oz*(c[10]*oz+2*c[11])+c[15];const root=b*b-a*e;if(root<0)continue;const q=-(b+(b<0?-1:1)*Math.sqrt(
root));for(let side=0;side<2;side+=1){const t=side?e/q:q/a;if(!(Math.abs(t)<=half))continue;let at2=count;while(at2>0&&far[at2-1]>t){far[at2]=far[at2-1];which[at2]=
which[at2-1];at2-=1}far[at2]=t;which[at2]=k;count+=1}}if(!count)continue;let red=0,green=0,blue=0,through=1;for(let k=0;k<count;k+=1){const t=far[k],c=quadrics[which[k]],
own=paint[which[k]];const x=ox+t*dx,y=oy+t*dy,z=oz+t*dz;let nx=c[0]*x+c[1]*y+c[2]*z+c[3];let ny=c[4]*x+c[5]*y+c[6]*z+c[7];let nz=c[8]*x+c[9]*y+c[10]*z+c[11];const n=1/
Math.sqrt(nx*nx+ny*ny+nz*nz);nx*=n;ny*=n;nz*=n;const facing=Math.abs(nx*dx+ny*dy+nz*dz);const pixels=(middle2+t)*reach[1]/height*(Math.sqrt(Math.max(0,1-nz*nz))/
Math.max(facing,.15))+1e-4;const z3=zc+zh*z,turns=(2*Math.atan(z3)+middleAngle)/step;const off=Math.abs(turns-Math.round(turns))*step*(1+z3*z3)/(2*zh);const line2=1-
clamp((off/pixels-.5)/1.1,0,1);const lit=(.42+.58*Math.abs(nx*lamp[0]+ny*lamp[1]+nz*lamp[2]))*(1-.35*line2);const alpha=.5+.42*(1-facing)*(1-facing),share=through*
alpha;red+=share*own[0]*lit;green+=share*own[1]*lit;blue+=share*own[2]*lit;through*=1-alpha}const at=4*(j*width+i),whole=255/(1-through);data[at]=red*whole;data[at+
1]=green*whole;data[at+2]=blue*whole;data[at+3]=255*(1-through)}}}var STILL_MILLISECONDS=250;var TURNING_MILLISECONDS=25;var UNIFORMS=["surface","paint","eye","right","up","ahead","reach","pixel","samples","angles"];var VERTEX=`\
#version 300 es
in vec2 corner;
out vec2 at;
void main() { at = corner; gl_Position = vec4(corner, 0.0, 1.0); }`;var FRAGMENT=`#version 300 es
precision highp float;
in vec2 at;
out vec4 colour;
uniform mat4 surface[2];
uniform vec3 paint[2];
uniform vec3 eye, right, up, ahead;
uniform vec2 reach;   // half the picture's width and height, over the distance to it
uniform vec2 pixel;   // a pixel's share of at
uniform int samples;
uniform vec4 angles;  // of M: Z3 in the middle of the box and half its height, middle angle, step of lines

void meet(mat4 c, vec3 o, vec3 d, out float t1, out float t2) {
  vec4 o4 = vec4(o, 1.0), d4 = vec4(d, 0.0);
  vec4 cd = c * d4;
  float a = dot(d4, cd), b = dot(o4, cd), e = dot(o4, c * o4);
  float root = b * b - a * e;
  t1 = t2 = 1e9;
  if (root < 0.0) return;
  float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(root));
  if (abs(a) > 1e-9 * abs(q)) t1 = q / a;
  if (q != 0.0) t2 = e / q;
}

vec4 ray(vec2 xy) {
  vec3 d = normalize(ahead + xy.x * reach.x * right + xy.y * reach.y * up);
  vec3 near3 = (-1.0 - eye) / d, far3 = (1.0 - eye) / d;
  vec3 least = min(near3, far3), most = max(near3, far3);
  float enter = max(max(least.x, least.y), least.z), leave = min(min(most.x, most.y), most.z);
  if (enter >= leave) return vec4(0.0);
  float middle = (enter + leave) / 2.0;
  vec3 o = eye + middle * d;
  float reachable = (leave - enter) / 2.0;
  vec2 hit[4]; // how far, and which surface
  meet(surface[0], o, d, hit[0].x, hit[1].x);
  meet(surface[1], o, d, hit[2].x, hit[3].x);
  hit[0].y = hit[1].y = 0.0;
  hit[2].y = hit[3].y = 1.0;
  // Sorted, each pair first.
  for (int k = 0; k < 5; k++) {
    int i = k == 1 ? 2 : k == 3 ? 1 : k == 4 ? 1 : 0, j = k == 0 ? 1 : k == 1 ? 3 : k == 2 ? 2 : k == 3 ? 3 : 2;
    if (hit[i].x > hit[j].x) { vec2 other = hit[i]; hit[i] = hit[j]; hit[j] = other; }
  }
  vec3 light = vec3(0.0);
  float through = 1.0;
  for (int k = 0; k < 4; k++) {
    float t = hit[k].x;
    if (abs(t) > reachable) continue;
    bool first = hit[k].y < 0.5;
    vec3 p = o + t * d;
    vec3 n = normalize(((first ? surface[0] : surface[1]) * vec4(p, 1.0)).xyz);
    float facing = abs(dot(n, d));
    vec3 lamp = normalize(-ahead + 0.5 * up - 0.6 * right);
    float lit = 0.42 + 0.58 * abs(dot(n, lamp));
    float shine = pow(abs(dot(n, normalize(lamp - d))), 40.0);
    float width = (middle + t) * pixel.y * reach.y * sqrt(max(0.0, 1.0 - n.z * n.z)) / max(facing, 0.15) + 1e-4;
    float z = angles.x + angles.y * p.z;
    float turns = (2.0 * atan(z) + angles.z) / angles.w;
    float off = abs(fract(turns + 0.5) - 0.5) * angles.w * (1.0 + z * z) / (2.0 * angles.y);
    float line = 1.0 - smoothstep(0.5 * width, 1.6 * width, off);
    float alpha = mix(0.5, 0.92, pow(1.0 - facing, 2.0));
    vec3 own = (first ? paint[0] : paint[1]) * lit * (1.0 - 0.35 * line) + 0.22 * shine;
    light += through * alpha * own;
    through *= 1.0 - alpha;
  }
  return vec4(light, 1.0 - through);
}

void main() {
  if (samples == 1) { colour = ray(at); return; }
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 4; k++) {
    vec2 part = vec2(k % 2 == 0 ? -0.5 : 0.5, k < 2 ? -0.5 : 0.5);
    sum += ray(at + part * pixel);
  }
  colour = sum / 4.0;
}`;function hasGraphics(){const gl=document.createElement("canvas").getContext("webgl2",{failIfMajorPerformanceCaveat:true});const named=gl?.getExtension("WEBGL\
_debug_renderer_info");const name=gl&&named?gl.getParameter(named.UNMASKED_RENDERER_WEBGL):"";return Boolean(gl)&&!/swiftshader|llvmpipe|softpipe|software|basic render/i.
test(name)}var Shader=class _Shader{pace;static on(canvas,lost){if(!hasGraphics())return null;const gl=canvas.getContext("webgl2",{antialias:false,premultipliedAlpha:true,
preserveDrawingBuffer:true});if(!gl)return null;const program=gl.createProgram();for(const[kind,source]of[[gl.VERTEX_SHADER,VERTEX],[gl.FRAGMENT_SHADER,FRAGMENT]]){
const shader=gl.createShader(kind);gl.shaderSource(shader,source);gl.compileShader(shader);gl.attachShader(program,shader)}gl.linkProgram(program);if(!gl.getProgramParameter(
program,gl.LINK_STATUS)){lost();return null}canvas.addEventListener("webglcontextlost",lost,{once:true});return new _Shader(canvas,gl,program)}constructor(canvas,gl,program){
this.canvas=canvas;this.gl=gl;gl.useProgram(program);gl.bindBuffer(gl.ARRAY_BUFFER,gl.createBuffer());gl.bufferData(gl.ARRAY_BUFFER,new Float32Array([-1,-1,3,-1,
-1,3]),gl.STATIC_DRAW);const corner=gl.getAttribLocation(program,"corner");gl.enableVertexAttribArray(corner);gl.vertexAttribPointer(corner,2,gl.FLOAT,false,0,0);
this.places=Object.fromEntries(UNIFORMS.map(name=>[name,gl.getUniformLocation(program,name)]))}draw(scene,size2,turning){const{gl,places}=this;gl.clearColor(0,0,
0,0);if(!scene.quadrics.length){gl.clear(gl.COLOR_BUFFER_BIT);return}gl.uniformMatrix4fv(places.surface,false,new Float32Array(scene.quadrics.flat()));gl.uniform3fv(
places.paint,new Float32Array(scene.paint.flat()));for(const name of["eye","right","up","ahead"])gl.uniform3fv(places[name],scene[name]);gl.uniform2fv(places.reach,
scene.reach);gl.uniform4fv(places.angles,scene.angles);this.pace??=this.measure(size2);const full=Math.min(2,window.devicePixelRatio||1),most=turning?TURNING_MILLISECONDS:
STILL_MILLISECONDS;const ways=turning?[[1,1],[.7,1],[.45,1]]:[[full,4],[1,4],[full,1],[1,1],[.7,1]];const fits=ways.find(([dense,samples])=>dense*dense*samples*
this.pace*size2.width*size2.height<most);this.once(size2,...fits??ways[ways.length-1])}measure(size2){const{gl}=this;this.once(size2,.12,1);gl.finish();const start=performance.
now();this.once(size2,.3,1);gl.finish();return(performance.now()-start)/(.09*size2.width*size2.height)}once(size2,dense,samples){const{gl,canvas,places}=this;const width=Math.
round(size2.width*dense),height=Math.round(size2.height*dense);if(canvas.width!==width||canvas.height!==height){canvas.width=width;canvas.height=height}gl.viewport(
0,0,width,height);gl.clear(gl.COLOR_BUFFER_BIT);gl.uniform2f(places.pixel,1/width,1/height);gl.uniform1i(places.samples,samples);gl.drawArrays(gl.TRIANGLES,0,3)}};var FOCAL_LENGTH=2.3;var EYE_DISTANCE=4.6;var START={around:-.62,above:.38,zoom:1};var MANY_POSES3=40;var inside=point2=>point2.every(value=>Math.abs(value)<=1.0001);
var ImageSpace=class{waiting;space;marks;view;width;height;constructor(data,parent,webgl){this.data=data;this.parent=parent;this.turn={...START};this.canvas=h("\
canvas",{"aria-hidden":"true"});this.svg=s("svg",{"aria-hidden":"true"});this.note=h("p",{class:"bm-readout"});this.box=h("div",{class:"bm-space",role:"img",tabindex:"\
0","aria-label":"Image space: two surfaces and the curve they meet in. Arrow keys turn it, plus and minus zoom."},this.canvas,this.svg);parent.append(this.box,this.
note);this.shader=webgl?Shader.on(this.canvas,()=>this.withoutGl()):null;this.explain();this.listen()}explain(){this.canvas.dataset.drawn=this.shader?"webgl":"s\
till";this.note.textContent=this.shader?"Drag it, or turn it with the arrow keys; + and − zoom, 0 goes back.":"A still picture, for fast WebGL 2 is missing he\
re; it can be turned all the same, by dragging or with the arrow keys."}withoutGl(){const fresh=this.canvas.cloneNode();this.canvas.replaceWith(fresh);this.canvas=
fresh;this.shader=null;this.explain();if(this.space)this.draw(false)}listen(){const{box}=this;let grip=null;box.addEventListener("pointerdown",event=>{grip=[event.
clientX,event.clientY];box.setPointerCapture(event.pointerId)});box.addEventListener("pointermove",event=>{if(!grip)return;this.turn.around-=.008*(event.clientX-
grip[0]);this.turn.above+=.008*(event.clientY-grip[1]);grip=[event.clientX,event.clientY];this.redraw(true)});for(const end of["pointerup","pointercancel"]){box.
addEventListener(end,()=>{if(grip)this.redraw(false);grip=null})}box.addEventListener("keydown",event=>{const{turn}=this;const step={ArrowLeft:()=>turn.around+=
.1,ArrowRight:()=>turn.around-=.1,ArrowUp:()=>turn.above+=.1,ArrowDown:()=>turn.above-=.1,"+":()=>turn.zoom*=1.15,"=":()=>turn.zoom*=1.15,"-":()=>turn.zoom/=1.15,
0:()=>Object.assign(turn,START)}[event.key];if(!step||event.ctrlKey||event.metaKey||event.altKey)return;event.preventDefault();event.stopPropagation();step();this.
redraw(false)})}redraw(turning){this.turn.above=clamp(this.turn.above,-1.5,1.5);this.turn.zoom=clamp(this.turn.zoom,.6,4);cancelAnimationFrame(this.waiting);this.
waiting=requestAnimationFrame(()=>this.draw(turning))}point(place){const{chart}=this.data,{centre,half}=this.space;const x=(place.x-chart.origin[0])/chart.length,
y=(place.y-chart.origin[1])/chart.length;const t=Math.tan((place.a-chart.angle)/2);return[(x*t-y)/2,(x+y*t)/2,t].map((value,k)=>(value-centre[k])/half[k])}build(linkage,index,quick=false){
this.linkage=linkage;this.space=linkage?.space??this.data.space;this.poses=this.data.poses.map((pose,k)=>{const at=isPoint(pose)?linkage?.pose_errors[k]:pose;return at&&
at.x!==null?this.point({x:at.x,y:at.y,a:radians(at.angle_deg)}):null});this.curves=(linkage?.ways??[]).map((way,k)=>({here:k===index,points:Array.from(way.x,(x,i)=>this.
point({x,y:way.y[i],a:way.angle[i]}))}));const{centre,half}=this.space;const angleOf=q=>degrees(2*Math.atan(centre[2]+half[2]*q)+this.data.chart.angle);this.marks=
angleTicks(angleOf(-1),angleOf(1),7);const width=Math.max(240,this.parent.clientWidth);this.width=width;this.height=Math.round(clamp(.8*width,240,520));this.svg.
setAttribute("viewBox",`0 0 ${width} ${this.height}`);this.box.style.height=`${this.height}px`;this.draw(quick)}camera(){const{around:around3,above,zoom}=this.turn;
const ahead=[-Math.cos(above)*Math.sin(around3),Math.cos(above)*Math.cos(around3),-Math.sin(above)];const right=[Math.cos(around3),Math.sin(around3),0];const up=cross2(
right,ahead);const eye=scaled(ahead,-EYE_DISTANCE);const least2=Math.min(this.width,this.height);const focal=least2/2*FOCAL_LENGTH*zoom*1.02;return{ahead,right,
up,eye,focal,reach:[this.width/2/focal,this.height/2/focal]}}draw(turning){this.view=this.camera();const scene=this.sceneOf(this.view);if(this.shader)this.shader.
draw(scene,this,turning);else drawStill(this.canvas,scene,this,turning);this.overlay();if(this.place)this.show(this.place)}sceneOf(camera){const style=getComputedStyle(
this.parent);const paint=["--bm-driver-solid","--bm-follower-solid"].map(name=>rgb(style.getPropertyValue(name)).map(v=>v/255));return{...camera,paint,quadrics:this.
space.quadrics,angles:this.angles()}}angles(){const{centre,half}=this.space,{marks}=this;const step=marks.length>1?radians(marks[1].at-marks[0].at):Math.PI;return[
centre[2],half[2],this.data.chart.angle,step]}project(point2){const{eye,ahead,right,up,focal}=this.view;const to=[0,1,2].map(k=>point2[k]-eye[k]),depth=dot(to,ahead);
return[this.width/2+focal*dot(to,right)/depth,this.height/2-focal*dot(to,up)/depth]}sheetsBefore(point2){const to=plus(this.view.eye,scaled(point2,-1)),d=unit(to);
let leave=Infinity;for(let k=0;k<3;k+=1)leave=Math.min(leave,((d[k]>0?1:-1)-point2[k])/d[k]);let count=0;for(const c of this.space.quadrics)for(const t of intersections(
c,point2,d))if(t>.02&&t<leave)count+=1;return count}overlay(){const{svg}=this;const back2=this.view.ahead.map(value=>value>0?1:-1);svg.replaceChildren(...this.edges(
back2),...this.axisNames(back2),...this.angleMarks(),...this.motions());this.images();this.runner=s("circle",{class:"bm-runner",r:6,visibility:"hidden"});svg.append(
this.runner)}edges(back2){let front="",behind="";for(let axis=0;axis<3;axis+=1){for(const[b,c]of[[-1,-1],[-1,1],[1,-1],[1,1]]){const one=[0,0,0],[j,k]=[(axis+1)%
3,(axis+2)%3];[one[j],one[k],one[axis]]=[b,c,-1];const other=[...one];other[axis]=1;const d=`M${this.project(one).map(px).join(" ")}L${this.project(other).map(px).
join(" ")}`;if(b===back2[j]&&c===back2[k])behind+=d;else front+=d}}return[s("path",{class:"bm-box bm-behind",d:behind}),s("path",{class:"bm-box",d:front})]}axisNames(back2){
const name=(point2,text)=>{const[x,y]=this.project(point2),[cx,cy]=[x-this.width/2,y-this.height/2];const size2=Math.hypot(cx,cy)||1;return s("text",{class:"bm-\
axis",x:px(x+14*cx/size2),y:px(y+14*cy/size2+4),"text-anchor":"middle"},text)};const base=this.turn.above>=0?-1:1;return[name([0,-back2[1],base],"Z1"),name([-back2[0],
0,base],"Z2")]}angleMarks(){const upright=[[-1,-1],[-1,1],[1,-1],[1,1]].map(([a,b])=>({a,b,x:this.project([a,b,0])[0]}));const edge=upright.reduce((one,other)=>other.
x<one.x?other:one);const{centre,half}=this.space;return this.marks.flatMap(({at,text})=>{const t=Math.tan((radians(at)-this.data.chart.angle)/2),q=(t-centre[2])/
half[2];const[x,y]=this.project([edge.a,edge.b,q]);return[s("path",{class:"bm-box",d:`M${px(x)} ${px(y)}h-5`}),s("text",{class:"bm-axis",x:px(x-8),y:px(y+4),"te\
xt-anchor":"end"},text)]})}motions(){return this.curves.flatMap(({here,points})=>{const paths=["",""];let last=null;for(let k=0;k<points.length;k+=1){const p=points[k];
if(!inside(p)||k&&Math.hypot(...plus(p,scaled(points[k-1],-1)))>.6)last=null;if(!inside(p))continue;const at=this.project(p),hidden=this.sheetsBefore(p)>0?1:0;if(last)
paths[hidden]+=`M${last.map(px).join(" ")}L${at.map(px).join(" ")}`;last=at}const kind=here?"bm-here":"bm-other";return[s("path",{class:`bm-motion bm-hidden ${kind}`,
d:paths[1]}),s("path",{class:`bm-motion ${kind}`,d:paths[0]})]})}images(){const{svg,data}=this;const labels=new Labels({width:this.width,height:this.height});const shown2=this.
poses.map((point2,k)=>({point:point2,k})).filter(({point:point2})=>point2&&inside(point2));for(const{point:point2}of shown2){const[x,y]=this.project(point2);labels.
block(x,y,10,10)}for(const{point:point2,k}of shown2){const[x,y]=this.project(point2),hidden=this.sheetsBefore(point2)>0;svg.append(s("circle",{class:`bm-image-p\
oint${hidden?" bm-hidden":""}`,cx:px(x),cy:px(y),r:4}));if(shown2.length<=MANY_POSES3&&isNamed(data,k))svg.append(labels.put(x,y,data.poses[k].label,12,{class:"\
bm-image-name"}))}}hide(){this.place=null;this.runner.setAttribute("visibility","hidden")}show(place){this.place=place;const point2=this.point(place);const inside2=point2.
every(value=>Math.abs(value)<=1.02);this.runner.setAttribute("visibility",inside2?"visible":"hidden");if(!inside2)return;const[x,y]=this.project(point2);this.runner.
setAttribute("transform",`translate(${px(x)} ${px(y)})`)}};function coefficients(dyad,{origin,angle,length}){const c=Math.cos(angle),d=Math.sin(angle);const hand=dyad.moving_pivot&&[(c*dyad.moving_pivot[0]-d*dyad.moving_pivot[1])/
length,(d*dyad.moving_pivot[0]+c*dyad.moving_pivot[1])/length];const foot2=dyad.fixed_pivot&&dyad.fixed_pivot.map((value,k)=>(value-origin[k])/length);if(dyad.kind===
"RR"){const[x,y]=hand,[xc,yc]=foot2,squared=(dyad.radius/length)**2/4;const s1=-(x+xc)/2,s2=-(y+yc)/2,t1=-(y-yc)/2,t2=(x-xc)/2;return[1,s1*s1+s2*s2-squared,2*s1,
2*s2,2*t1,2*t2,2*(s1*t1+s2*t2),t1*t1+t2*t2-squared]}const normal=radians(dyad.line.normal_deg);if(dyad.kind==="PR"){const n=[Math.cos(normal),Math.sin(normal)];
return line(normal,(dyad.line.offset-n[0]*origin[0]-n[1]*origin[1])/length,hand)}return line(normal+angle,dyad.line.offset/length,foot2).map((value,k)=>k>=4&&k<
7?-value:value)}function line(normal,offset,[x,y]){const n1=Math.cos(normal),n2=Math.sin(normal),along2=n1*x+n2*y,across=n2*x-n1*y;return[0,-along2-offset,2*n1,
2*n2,-2*n2,2*n1,2*across,along2-offset]}function matrixOf(dyad,chart){if(dyad.kind==="PP"){const half=(radians(dyad.angle_deg)-chart.angle)/2;return[0,0,0,0,0,0,
0,0,0,0,0,Math.cos(half)/2,0,0,Math.cos(half)/2,-Math.sin(half)]}const[p1,p2,p3,p4,p5,p6,p7,p8]=coefficients(dyad,chart);return[p1,0,p3/2,p5/2,0,p1,p4/2,p6/2,p3/
2,p4/2,p2,p7/2,p5/2,p6/2,p7/2,p8]}function quadricOf(dyad,chart,{centre,half}){const c=matrixOf(dyad,chart),to=(r,k)=>r===k?k<3?half[k]:1:k===3?centre[r]:0;const out=new Array(
16).fill(0);for(let i=0;i<4;i+=1){for(let j=0;j<4;j+=1){for(let r=0;r<4;r+=1)for(let k=0;k<4;k+=1)out[4*i+j]+=to(r,i)*c[4*r+k]*to(k,j)}}const greatest=Math.max(
...out.map(Math.abs));return out.map(value=>value/greatest)}var CALM=200;var SpacePanel=class{constructor(answers,playing){this.answers=answers;this.playing=playing;this.story=h("p",{class:"bm-story"});const fill=h("div",
{class:"bm-fill"});this.element=h("div",{},this.story,fill);this.fill=fill;this.space=new ImageSpace(answers.data,fill,true);this.quick=new Pace(()=>this.build(
true),()=>isSeen(fill));playing.on("shape",()=>this.ask());answers.on("poses placed",()=>this.ask());playing.on("place",({place})=>{if(this.space.view&&!answers.
isOld&&isSeen(fill))this.space.show(place)});new ResizeObserver(()=>this.ask()).observe(fill);watch(fill,()=>this.ask())}ask(){this.quick.ask();clearTimeout(this.
calm);this.calm=setTimeout(()=>isSeen(this.fill)&&this.build(false),CALM)}get dyads(){const{linkage}=this.playing,{placed}=this.answers.store;if(!linkage&&placed?.
dyads?.length)return placed.dyads;return linkage?.led??[]}build(quick){const{answers,playing,space,dyads}=this,{data}=answers,{linkage}=playing;if(!data.poses.length)
return;const box=linkage?.space??data.space;const quadrics=dyads.map(dyad=>quadricOf(dyad,data.chart,box));if(quadrics.length===1)quadrics.push(quadrics[0]);const shown2={
...linkage&&!linkage.gone?linkage:{ways:[],led:dyads},space:{...box,quadrics}};const key=dyads.map(dyad=>dyad.id).join();if(key!==this.told){this.told=key;this.
story.replaceChildren(...spaceStory(data,linkage&&dyads.length===2?{id:linkage.id,led:dyads}:null))}space.build(shown2,playing.player.way,quick);if(playing.path&&
playing.here)space.show(playing.here.place);else space.hide()}};var LOADS=["loads","springs","drive"];function addResults(store,scene,{player,results,drawer}){const answers=new Answers(store),playing=new Playing(store,answers);
const live=new LiveLinkage(answers,playing,scene),surface=new PivotSurface(store,answers,playing,scene);const centrodes=new Centrodes(answers,playing,scene),curves=new CouplerCurves(
answers,playing,scene);const cards=new Results(store,answers),charts=new Charts(answers,playing),space=new SpacePanel(answers,playing);const cognates=new CognatePanel(
store,answers),loads=new LoadCharts(answers,playing);const compare=new Compare(store,answers,playing,()=>drawer.open("compare")),facts=new FactsTable(store,answers,
playing,curves);const ways=[...playing.element.querySelectorAll(".bs-player-ways, .bs-driver-note")];player.append(playing.element);results.append(cards.element);
const ofAngles=()=>!store.document.poses.some(isPoint2);drawer.add("charts","Errors and transmission",charts.element);drawer.add("loads","Loads",loads.element,()=>LOADS.
some(key=>store.document[key]));drawer.add("motion","Driver and curves",h("div",{},ways,h("div",{class:"bs-player-tools"},centrodes.element,curves.element)));drawer.
add("cognates","Cognates",cognates.element,()=>isOfPoints(store.document));drawer.add("pivots","Pivots",surface.element,ofAngles);drawer.add("space","Image spac\
e",space.element,ofAngles);drawer.add("compare","Compare",compare.element);drawer.add("facts","Tables",facts.element);store.on("document",()=>drawer.update());drawer.
update();unfoldForPrint(drawer.element,new AbortController().signal);catchUpForPrint();listenToSpace(playing);playOnce(store,answers,playing);matchMedia("(prefe\
rs-color-scheme: dark)").addEventListener("change",()=>answers.emit("answers"));return{answers,playing,live,surface,centrodes,curves,cards,charts,loads,space,cognates,
compare,facts}}var FEW2=40;var PointFields=class{constructor({name,options,step,set}){this.name=name;this.options=options;this.step=step;this.set=set;this.fields=[];this.shape=
h("span",{class:"bs-hint"});this.more=h("p",{class:"bs-hint"});this.pairs=h("div",{class:"bs-coordinates"});this.element=h("div",{class:"bs-point-fields"},this.
shape,this.pairs,this.more)}show(shape,points){const count=Math.min(points.length,FEW2);if(shape!==this.shape.textContent)this.fields=[];say(this.shape,shape);while(this.
fields.length<count)this.fields.push(this.make(this.fields.length));this.fields.length=count;const wanted=this.fields.map(each=>each.element);if(wanted.length!==
this.pairs.children.length||wanted.some((each,k)=>each!==this.pairs.children[k]))this.pairs.replaceChildren(...wanted);this.fields.forEach(({pair},k)=>pair.forEach(
(field,i)=>field.show(points[k][i])));give(this.more,"hidden",points.length<=FEW2);say(this.more,`and ${points.length-FEW2} more, to drag in the plane`)}make(k){
const pair=["x","y"].map((axis,i)=>new NumberField({label:`${axis} of point ${k+1} of ${this.name}`,options:()=>({...this.options(),optional:false}),step:this.step,
commit:value=>this.set(points=>points.map((point2,j)=>j===k?point2.map((old,m)=>m===i?value:old):point2))}));return{pair,element:h("span",{class:"bs-pair"},pair.
map(field=>field.element))}}};var SHAPES=["point","line","segment","box","polygon"];var SIGMA=[["position","position","length"],["angle_deg","angle","angle"]];var UNITS2=["","mm","cm","m","i\
n","ft"];var section=(name,title,open,...content)=>h("details",{class:"bs-section","data-section":name,open},h("summary",{},title),...content);var TaskPanel=class{madeTables;regionRows;linkWidth;margin;inPlane;bodyNumbers;asks;options;tables;apart;regionList;sigma;constructor(store,scene,regions,body,files,form){
this.store=store;this.scene=scene;this.regions=regions;this.body=body;this.files=files;this.form=form;this.element=h("div",{class:"bs-task"});this.element.append(
this.makeRequirements(),this.makeLimits(),this.makeRegions(),this.makeBody(),this.makeSigma(),this.makeOptions());store.on("document selection",()=>this.draw());
regions.onjudged=()=>this.drawVerdicts();this.draw()}edit(change){this.store.edit(change)}length(label,commit,options={},attributes={}){return new NumberField({
label,commit,options:()=>({kind:"length",unit:this.store.document.length_unit,optional:true,...options}),step:()=>this.scene.step,attributes})}tools(label,shapes,toolOf,data){
return h("div",{class:"bs-tools",role:"group","aria-label":label},shapes.map(shape=>this.toolButton(shape,()=>toolOf(shape),{"data-draw":`${data} ${shape}`})))}toolButton(text,toolOf,attributes){
const made2=button(text,()=>this.scene.use(made2.tool&&made2.tool===this.scene.tool?null:made2.tool=toolOf()),{"aria-pressed":"false",...attributes});this.scene.
on("tool",tool=>put(made2,"aria-pressed",Boolean(tool)&&tool===made2.tool));return made2}points(name,set){return new PointFields({name,set,options:()=>({kind:"l\
ength",unit:this.store.document.length_unit}),step:()=>this.scene.step})}makeLimits(){this.apart=tick("another limit for each of the two dyads",on=>this.edit(document2=>splitLimits(
document2,on)),{"data-key":"limits-apart"});this.tables=h("div",{});this.madeTables=[];return section("limits","Limits of pivots and links",false,this.apart.element,
this.tables)}limitsOf(form){return this.form.limits.filter(each=>each.form===form)}makeTable(k){const{store,regions}=this,edit=changes=>this.edit(document2=>setLimit(
document2,k,changes));const title=h("h3",{}),parts={};for(const{key,label:name}of this.limitsOf("region")){const state=h("p",{class:"bs-state"});const numbers=this.
points(`the limit of the ${key.replace("_"," ")}`,change=>this.edit(document2=>withPoints(document2,k,key,change)));const remove=button("Delete",()=>regions.removeLimit(
k,key),{"data-do":`delete-limit-${k}-${key}`,"aria-label":`Delete the limit: ${name}`});parts[key]={state,numbers,remove};parts[key].element=h("div",{class:"bs-\
limit-box"},h("h4",{},name),this.tools(`Draw a limit: ${name}`,SHAPES,shape=>regions.limitTool(k,key,shape),`limit ${k} ${key}`),numbers.element,state,remove)}const least2=this.
length("least length",value=>edit({length:range(value,limitsOf(store.document)[k]?.length?.most)}),{least:0},{"data-key":`least-${k}`,placeholder:"any"});const most=this.
length("greatest length",value=>edit({length:range(limitsOf(store.document)[k]?.length?.least,value)}),{least:0},{"data-key":`most-${k}`,placeholder:"any"});const[
{label,choices}]=this.limitsOf("kinds");const kinds=choices.map(([kind,text])=>({kind,...tick(`${kind}: ${text}`,()=>edit({kinds:kindsOf2(kinds)}),{"data-key":`\
kind-${k}-${kind}`})}));const lengthState=h("p",{class:"bs-state"}),kindsState=h("p",{class:"bs-state"});const element=h("div",{class:"bs-limit-table"},title,Object.
values(parts).map(part=>part.element),h("div",{class:"bs-row"},labelled("length from",least2.element),labelled("to",most.element)),lengthState,h("div",{class:"b\
s-row",role:"group","aria-label":label},kinds.map(each=>each.element)),kindsState);return{element,title,parts,least:least2,most,kinds,lengthState,kindsState}}drawLimits(){
const{document:document2}=this.store,tables=limitsOf(document2),count=Math.max(1,tables.length);give(this.apart.box,"checked",tables.length>1);while(this.madeTables.
length<count)this.madeTables.push(this.makeTable(this.madeTables.length));while(this.tables.children.length>count)this.tables.lastChild.remove();while(this.tables.
children.length<count)this.tables.append(this.madeTables[this.tables.children.length].element);for(let k=0;k<count;k+=1){const table3=tables[k]??{},made2=this.madeTables[k];
say(made2.title,count>1?`Dyad ${k+1}`:"Both dyads");for(const key of Object.keys(made2.parts))this.drawLimit(made2.parts[key],table3[key]);made2.least.show(table3.
length?.least);made2.most.show(table3.length?.most);for(const{kind,box}of made2.kinds)box.checked=!table3.kinds||table3.kinds.includes(kind)}}drawLimit({numbers,
remove},region){for(const each of[remove,numbers.element])give(each,"hidden",!region);if(!region)return;const[[shape,stated]]=Object.entries(region);numbers.show(
shape,shape==="point"?[stated]:stated)}drawVerdicts(){const{regions}=this,tables=limitsOf(this.store.document);this.madeTables.forEach((made2,k)=>{for(const key of Object.
keys(made2.parts))tell(made2.parts[key].state,tables[k]?.[key]?regions.said(k,key):null);tell(made2.lengthState,tables[k]?.length?regions.said(k,"length"):null);
tell(made2.kindsState,tables[k]?.kinds?regions.said(k,"kinds"):null)});this.regionRows.forEach((row,k)=>tell(row.state,regions.touched?[regions.touched[k]].filter(
Boolean):null))}makeRegions(){this.regionList=h("div",{});this.regionRows=[];this.linkWidth=this.length("width of the links",value=>this.edit(document2=>setSurrounding(
document2,"link_width",value)),{least:0},{"data-key":"link_width",placeholder:"0"});this.margin=this.length("least clearance",value=>this.edit(document2=>setSurrounding(
document2,"margin",value)),{least:0},{"data-key":"margin",placeholder:"0"});this.inPlane=tick("links that stand on the ground must not touch the body either",on=>this.
edit(document2=>setSurrounding(document2,"body_in_plane",on||void 0)),{"data-key":"body_in_plane"});return section("keep-out","Regions to keep out of",false,h("\
p",{class:"bs-hint"},"The body and the links must not touch them between the poses."),this.tools("Draw a region to keep out of",["box","polygon"],shape=>this.regions.
regionTool(shape),"region"),this.regionList,h("div",{class:"bs-row"},labelled("links are wide",this.linkWidth.element),labelled("least clearance",this.margin.element)),
this.inPlane.element)}drawRegions(){const{store}=this,regions=regionsOf(store.document);while(this.regionRows.length<regions.length){this.regionRows.push(this.regionRow(
this.regionRows.length));this.regionList.append(this.regionRows.at(-1).element)}for(const row of this.regionRows.splice(regions.length))row.element.remove();this.
regionRows.forEach((row,k)=>row.show(regions[k],store.selection?.kind==="region"&&store.selection.index===k));const{link_width,margin,body_in_plane}=store.document.
surroundings??{};this.linkWidth.show(link_width);this.margin.show(margin);give(this.inPlane.box,"checked",Boolean(body_in_plane))}regionRow(k){const{store}=this,
shapeKey=region=>region.box?"box":"polygon";const name=textField(`Name of region ${k+1}`,text=>this.edit(document2=>setRegion(document2,k,{name:text.trim()||void 0})),
{"data-key":`region-name-${k}`,placeholder:`region ${k+1}`});const numbers=this.points(`region ${k+1}`,change=>this.edit(document2=>{const region=regionsOf(document2)[k],
key=shapeKey(region);return setRegion(document2,k,{[key]:change(region[key])})}));const state=h("p",{class:"bs-state"}),inNumbers=h("details",{},h("summary",{},
"in numbers"),numbers.element),file=h("p",{class:"bs-hint"});const element=h("div",{class:"bs-limit-box","data-region-row":k,onfocusin:()=>store.select({kind:"r\
egion",index:k})},h("div",{class:"bs-row"},name,button("Delete",()=>this.regions.removeRegion(k),{"data-do":`delete-region-${k}`,"aria-label":`Delete region ${k+
1}`})),state,inNumbers,file);const show=(region,selected)=>{const text=(region.name??"").replace(/[\r\n]+/g," ");if(document.activeElement!==name&&name.value!==
text)name.value=text;element.classList.toggle("bs-selected",selected);give(inNumbers,"hidden",region.file!==void 0);give(file,"hidden",!inNumbers.hidden);if(inNumbers.
hidden)file.textContent=`from the drawing ${region.file}`;else numbers.show(shapeKey(region),region[shapeKey(region)])};return{element,state,show}}makeBody(){this.
bodyNumbers=this.points("the outline",change=>this.edit(document2=>setBody(document2,change(bodyOf(document2)))));this.bodyCount=h("summary",{});this.bodyBox=h(
"details",{},this.bodyCount,this.bodyNumbers.element);this.noBody=button("Delete the outline",()=>this.edit(document2=>setBody(document2,[])),{"data-do":"delete\
-body"});return section("body","Outline of the body",false,h("p",{class:"bs-hint"},"It is seen at every pose, moves with the linkage, and says what an angle err\
or counts as."),h("div",{class:"bs-tools"},this.toolButton("Draw it",()=>this.body.tool(),{"data-draw":"body"}),button("From a drawing (SVG, DXF)…",()=>this.files.
chooseOutline(),{"data-do":"outline-file"}),this.noBody),this.bodyBox)}drawBody(){const{document:task}=this.store,corners=bodyOf(task);give(this.noBody,"hidden",
!task.body);give(this.bodyBox,"hidden",!corners.length);if(!corners.length)return;say(this.bodyCount,`${corners.length} corners, in numbers`);this.bodyNumbers.show(
"polygon",corners)}makeRequirements(){this.asks=this.form.requirements.map(each=>({...each,...this.field(each,value=>this.edit(document2=>setRequirement(document2,
each.key,value)))}));const of=(...forms)=>this.asks.filter(({form})=>forms.includes(form)).map(({element})=>element);return section("requirements","What the lin\
kage must be",true,h("div",{class:"bs-grid"},of("number","corridor"),of("choice")),of("flag"),of("area"),of("names"))}field({key,label,form,choices,...bounds2},set){
const attributes={"data-key":key};switch(form){case"choice":case"word":{const[[usual]]=choices,element=choice(label,choices,value=>set(value===usual?void 0:value),
attributes);return{element:labelled(label,element),show:value=>element.value=value??usual}}case"flag":{const{box,element}=tick(label,on=>set(on||void 0),attributes);
return{element,show:value=>give(box,"checked",Boolean(value))}}case"names":{const ticks2=choices.map(([name,text])=>({name,...tick(text,()=>set(some(ticks2)),{"\
data-key":`${key}-${name}`})}));const element=h("details",{},h("summary",{},label),h("div",{class:"bs-ticks"},ticks2.map(each=>each.element)),h("p",{class:"bs-h\
int"},"None: any."));return{element,show:value=>ticks2.forEach(({name,box})=>box.checked=Boolean(value?.includes(name)))}}case"corridor":{const side=name=>new NumberField(
{label:`${label}, ${name}`,commit:()=>least2.value!==void 0&&greatest.value===void 0?void 0:set(both()),options:()=>({optional:true,kind:"number"}),attributes:{
"data-key":`${key}-${name}`,placeholder:"–"}});const least2=side("least"),greatest=side("greatest");const both=()=>greatest.value===void 0?void 0:least2.value===
void 0?greatest.value:[least2.value,greatest.value];const element=labelled(label,h("span",{class:"bs-pair"},least2.element,greatest.element)," ");return{element,
show:value=>[least2,greatest].forEach((field,k)=>field.show(Array.isArray(value)?value[k]:k?value:void 0))}}case"area":{const none=button("Delete",()=>set(void 0),
{"data-do":`delete-${key}`,"aria-label":`Delete the ${key}`});const element=h("div",{class:"bs-limit-box"},h("h4",{},label),this.tools(`Draw the ${key}`,["box",
"polygon"],shape=>this.regions.footprintTool(shape),key),none);return{element,show:value=>give(none,"hidden",!value)}}default:{const options=form==="length"?{kind:"\
length",above:0}:bounds2;const field=new NumberField({label,commit:set,options:()=>({optional:true,unit:this.store.document.length_unit,...options}),step:()=>form===
"length"?this.scene.step:1,attributes:{...attributes,placeholder:"–"}});return{element:labelled(label,field.element,options.kind==="angle"?"°":" "),show:value=>field.
show(value)}}}}drawRequirements(){const{requirements,loads,springs,drive}=this.store.document,loaded=Boolean(loads??springs??drive);for(const{key,show,element,loads:ofLoads}of this.
asks){show(requirements?.[key]);give(element,"hidden",Boolean(ofLoads)&&!loaded&&requirements?.[key]===void 0)}}makeOptions(){const{store}=this;this.unit=choice(
"unit of length",UNITS2.map(unit2=>[unit2,unit2||"not stated"]),value=>this.edit(document2=>withKeys(document2,{length_unit:value||void 0})),{"data-key":"length\
_unit"});this.options=this.form.options.map(each=>({...each,...this.field(each,value=>store.option(each.key,value))}));const of=form=>this.options.filter(each=>each.
form===form).map(({element})=>element);return section("options","Unit and method",false,h("div",{class:"bs-grid"},labelled("unit of length",this.unit),of("word"),
of("length")),h("p",{class:"bs-hint"},"Another unit leaves the numbers as they are."))}drawOptions(){const{document:document2,options}=this.store,unit2=document2.
length_unit??"";if(![...this.unit.options].some(each=>each.value===unit2))this.unit.append(h("option",{value:unit2},unit2));this.unit.value=unit2;for(const{key,
show}of this.options)show(options[key])}makeSigma(){const{store,scene}=this;this.wanted={};this.lack=h("p",{class:"bs-fault",hidden:true},"Give both: how far po\
sitions are off, and how far angles.");this.sigma=SIGMA.map(([key,name,kind])=>{const field=new NumberField({label:`standard deviation of the ${name}`,options:()=>({
kind,unit:store.document.length_unit,optional:true,above:0}),step:()=>kind==="angle"?.1:scene.step/10,commit:value=>this.setSigma(key,value),attributes:{"data-k\
ey":`sigma-${key}`,placeholder:"–"}});return{key,name,field}});return section("sigma","How well the poses are known",false,h("p",{class:"bs-hint"},"Standard d\
eviations of what was measured. Left empty: as well as their digits say."),h("div",{class:"bs-grid"},this.sigma.map(({name,field})=>labelled(`${name} ±`,field.
element,name==="angle"?"°":" "))),this.lack)}setSigma(key,value){this.wanted=withKeys({...this.store.document.pose_sigma,...this.wanted},{[key]:value});const given=Object.
keys(this.wanted).length;give(this.lack,"hidden",given!==1);if(given===1)return;const pose_sigma=given?this.wanted:void 0;this.wanted={};this.store.edit(document2=>withKeys(
document2,{pose_sigma}))}drawSigma(){const{pose_sigma}=this.store.document;this.wanted={};give(this.lack,"hidden",true);for(const{key,field}of this.sigma)field.
show(pose_sigma?.[key])}draw(){const{document:{limits,keep_out,surroundings,body,requirements,length_unit,pose_sigma},options,selection}=this.store;const now=[limits,
keep_out,surroundings,body,requirements,length_unit,pose_sigma,options,selection];if(now.every((each,k)=>each===this.drawn?.[k])&&this.drawn)return;if(!this.drawn||
pose_sigma!==this.drawn[6])this.drawSigma();this.drawn=now;this.drawLimits();this.drawRegions();this.drawBody();this.drawRequirements();this.drawOptions();this.
drawVerdicts()}};function tell(element,sentences){give(element,"hidden",sentences===null);if(sentences===null)return;put(element,"class",`bs-state ${sentences.length?
"bs-broken":"bs-met"}`);say(element,sentences.length?`✕ ${sentences.join(" ")}`:"✓ met by the chosen linkage")}function withPoints(document2,k,key,change){const[
[shape,stated]]=Object.entries(limitsOf(document2)[k][key]);return setLimit(document2,k,{[key]:shapeOf(shape,change(shape==="point"?[stated]:stated))})}var range=(least2,most)=>least2===
void 0&&most===void 0?void 0:{...least2===void 0?{}:{least:least2},...most===void 0?{}:{most}};function kindsOf2(kinds){const list=kinds.filter(({box})=>box.checked).
map(({kind})=>kind);return list.length===kinds.length||!list.length?void 0:list}function some(ticks2){const list=ticks2.filter(({box})=>box.checked).map(({name})=>name);
return list.length?list:void 0}var EMPTY="An empty task: add poses or points here, draw a path, paste rows of a spreadsheet, drop a file, or take a template.";var CURVE="Drag a point of the c\
urve, or draw another one: the linkages are looked for anew.";var POINTS2="Drag a pose or a point: the linkages are looked for anew.";var PATIENCE=700;var FIRST="\
Drag a pose by its point, turn it by the tip of its arrow: every linkage answers at once.";function layOut(root,store,start){const scene=new Scene(store),banners=new Banners(
store),files=new Files(store,start,banners);banners.files=files;const body=new BodyEditor(store,scene),regions=new Regions(store,scene);const settings=new ExportSettings(
store,scene,start.exports??[],files);const panel=new TaskPanel(store,scene,regions,body,files,start.form),handles=new PoseHandles(store,scene),table3=new PoseTable(
store,scene);const curve=new PathCurve(store,scene),path2=new PathPanel(store,scene);const player=h("div",{id:"bs-player"}),cards=h("div",{id:"bs-results"}),drawer=new Drawer;
const poses=h("details",{class:"bs-section bs-section-poses","data-section":"poses",open:true},h("summary",{},"Poses"),table3.element,path2.element);const left=sidePanel(
"left","The task",h("div",{class:"bs-left"},poses,panel.element));const right=sidePanel("right","Linkages",cards);root.replaceChildren(h("a",{class:"bs-skip",href:"\
#plane",onclick:event=>(event.preventDefault(),scene.svg.focus())},"Skip to the plane"),head(store,files,settings,banners,keyList()),banners.element,h("main",{class:"\
bs-main"},left,h("section",{class:"bs-stage",id:"plane","aria-label":"The plane"},stageBar(store,scene,()=>files.opened()),h("div",{class:"bs-canvas"},scene.element,
planeLine(store,scene)),player),sheets(root,[["task","Task",left],["linkages","Linkages",right],["drawer","Charts",drawer.element]]),right,drawer.element));scene.
resize();addResults(store,scene,{player,results:cards,drawer});listenToKeys(store,scene,files);new Autosave(store);files.opened=refitWhenSolved(store,scene);return{
scene,banners,files,body,regions,panel,handles,table:table3,curve,path:path2}}function head(store,files,settings,banners,keys){const name=h("input",{class:"bs-t\
ext bs-task-name","aria-label":"Name of the task",autocomplete:"off",spellcheck:"false",onchange:()=>store.rename(name.value.trim()||"task")});const undo=button(
"↶",()=>store.undo(),{"data-do":"undo",title:"Undo (Ctrl+Z)","aria-label":"Undo"}),redo=button("↷",()=>store.redo(),{"data-do":"redo",title:"Redo (Ctrl+Shif\
t+Z)","aria-label":"Redo"});const show=()=>{if(document.activeElement!==name)give(name,"value",store.name.replace(/[\r\n]+/g," "));give(undo,"disabled",!store.history.
canUndo);give(redo,"disabled",!store.history.canRedo)};store.on("document",show);show();const stop=button("Stop",()=>store.cancel(),{"data-do":"cancel",hidden:true,
"aria-label":"Stop solving"});let waiting;store.on("state",()=>{clearTimeout(waiting);if(store.state==="solving")waiting=setTimeout(()=>give(stop,"hidden",false),
PATIENCE);else give(stop,"hidden",true)});return h("header",{class:"bs-head"},h("h1",{},"burmester studio"),files.element,name,h("div",{class:"bs-row"},undo,redo),
banners.status,stop,banners.live,settings.element,keys)}function stageBar(store,scene,drawn){const toggle=(text,name,make,data)=>{const made2=button(text,()=>scene.
use(scene.tool?.name===name?null:make()),{"data-do":data,"aria-pressed":"false"});scene.on("tool",()=>put(made2,"aria-pressed",scene.tool?.name===name));return made2};
const zoom=(text,label,factor)=>button(text,()=>scene.zoom(factor,scene.size.width/2,scene.size.height/2),{"aria-label":label,title:label});const bar=h("div",{class:"\
bs-bar",role:"toolbar","aria-label":"Tools of the plane"},toggle("Add poses","pose",()=>new PoseTool(store,scene),"add-poses"),toggle("Add points","point",()=>new PointTool(
store,scene),"add-points"),toggle("Draw a path","path",()=>new PathTool(store,scene,drawn),"draw-path"),h("span",{class:"bs-gap"}),button("Fit",()=>scene.fitAgain(),
{"data-do":"fit",title:"Show the poses; once more: all of the body and the regions, too (0)"}),zoom("+","Zoom in",1.25),zoom("−","Zoom out",.8));walkByArrows(
bar,"button").first();return bar}function planeLine(store,scene){const line2=h("p",{class:"bs-line"});const show=()=>say(line2,scene.tool?.hint??(store.document.
poses.length?isPath(store.document)?CURVE:store.document.poses.some(isPoint2)?POINTS2:FIRST:EMPTY));scene.on("tool",show);store.on("document",show);show();return line2}
function refitWhenSolved(store,scene){let waits=true;scene.hold(()=>(waits?[]:currentLinkage(store)?.led??[]).map(dyad=>dyad.fixed_pivot).filter(point2=>point2&&
isNear(store,point2)));store.on("solved",()=>{const refit=waits&&scene.isFitted;waits=false;if(refit)scene.fit()});return()=>{waits=true;scene.fit()}}function isNear({
solved,document:{poses}},[x,y]){return poses.some(pose=>Math.hypot(x-pose.x,y-pose.y)<3*(solved?.scene??Infinity))}function listenToTokens(connection,banners){addEventListener(
"hashchange",async()=>{if(!location.hash)return;await connection.session();connection.open()});let asked=false;connection.on("open",()=>banners.close("expired"));
connection.on("closed",async()=>{if(asked)return;asked=true;try{await connection.get("/start")}catch(error){if(error instanceof Refused&&error.status===401)banners.
expired()}asked=false})}async function main(){const root=document.getElementById("studio"),connection=new Connection(decodeFrame);try{await connection.session();
const start=await connection.get("/start"),kept2=keptHere();const store=new Store({connection,document:start.document,options:start.options,name:start.name,...kept2});
const parts=layOut(root,store,start);if(start.saved&&!kept2)offerSaved(store,parts,start.saved);listenToTokens(connection,parts.banners);document.documentElement.
dataset.ready="true";connection.open()}catch(error){addEventListener("hashchange",()=>location.reload());const[told]=error instanceof Refused&&error.status===401?
error.messages:[];root.replaceChildren(h("p",{class:"bs-failed",role:"alert"},told?`The studio is not shown here: ${told.message}. What to do: ${told.help}.`:`T\
he page could not start: ${error.message}. Is burmester studio still running? Start it again and open the address that it prints.`));if(!(error instanceof Refused))
throw error}}function offerSaved(store,{banners,files},saved){const when=typeof saved.when==="number"?new Date(1e3*saved.when).toLocaleString():saved.when;banners.
say("saved",`Your task of last time, ${saved.name}${when?` (${when})`:""}, was kept.`,[],{actions:[button("Go on with it",()=>{banners.close("saved");store.replace(
saved);files.opened()},{"data-do":"restore"})]})}main();
