// Made by scripts/bundle from src/burmester/web/studio: change those files, not this one.
var SVG="http://www.w3.org/2000/svg";function furnish(node,attributes,children){for(let[name,value]of Object.entries(attributes??{}))value==null||value===!1||(name.
startsWith("on")?node.addEventListener(name.slice(2),value):node.setAttribute(name,value===!0?"":value));return node.append(...children.flat(1/0).filter(child=>child!=
null)),node}var h=(tag,attributes,...children)=>furnish(document.createElement(tag),attributes,children),s=(tag,attributes,...children)=>furnish(document.createElementNS(
SVG,tag),attributes,children);function put(node,name,value){let text=String(value);node.getAttribute(name)!==text&&node.setAttribute(name,text)}function give(node,name,value){
let next=typeof node[name]=="boolean"?!!value:String(value);node[name]!==next&&(node[name]=next)}function say(node,text){let next=String(text);node.textContent!==
next&&(node.textContent=next)}function rgb(text){let hex=text.trim().replace("#","");return[0,2,4].map(k=>parseInt(hex.slice(k,k+2),16))}var clamp=(value,low,high)=>Math.min(Math.max(value,low),high),degrees=angle=>angle*180/Math.PI,radians=angle=>angle*Math.PI/180,px=value=>Math.abs(value)<1e7?+value.
toFixed(5):Math.sign(value)*1e7;function fixed(value,digits){if(value==null||!Number.isFinite(value))return"–";let text=value.toFixed(digits);return Number(text)===
0?text.replace("-",""):text}function figure(value){if(value===null||!Number.isFinite(value))return"–";if(value===0)return"0";if(Math.abs(value)>=99.5&&Math.abs(
value)<1e6)return value.toFixed(0);let rounded=value.toExponential(1),[digits,power]=rounded.split("e").map(Number);return power>=-4&&power<2?String(Number(rounded)):
power>0?`${digits}e${power}`:`${digits}e-${String(-power).padStart(2,"0")}`}var spans=extent=>`${figure(extent)} span${figure(extent)==="1"?"":"s"}`;function ticks(low,high,about2){
let rough=(high-low)/Math.max(1,about2),power=10**Math.floor(Math.log10(rough)),step=[1,2,5,10].map(k=>k*power).find(each2=>each2>=rough*.999)??10*power,digits=Math.
max(0,-Math.floor(Math.log10(step*1.0001))),marks=[];for(let k=Math.ceil(low/step-1e-9);k*step<=high+step*1e-9;k+=1)marks.push({at:k*step,text:fixed(k*step,digits)});
return marks}function angleTicks(low,high,about2){let step=[5,10,15,30,45,60,90,180].find(each2=>(high-low)/each2<=about2)??360,marks=[];for(let k=Math.ceil(low/
step-1e-9);k*step<=high+1e-6;k+=1)marks.push({at:k*step,text:`${fixed(k*step,0)}°`});return marks.length>1?marks:ticks(low,high,about2).map(t=>({...t,text:`${t.
text}°`}))}function listed(words){return words.length<2?words.join(""):`${words.slice(0,-1).join(", ")} and ${words[words.length-1]}`}function runs(numbers,names){
let parts=[];for(let k=0;k<numbers.length;){let end=k;for(;end+1<numbers.length&&numbers[end+1]===numbers[end]+1;)end+=1;if(end-k>=2)parts.push(`${names[numbers[k]-
1]}–${names[numbers[end]-1]}`);else for(let i=k;i<=end;i+=1)parts.push(names[numbers[i]-1]);k=end+1}return listed(parts)}var LENGTHS={µm:1e-6,um:1e-6,mm:.001,cm:.01,m:1,in:.0254,inch:.0254,'"':.0254,"″":.0254,ft:.3048,"'":.3048,"′":.3048},ANGLES={"°":1,deg:1,degree:1,degrees:1,
rad:180/Math.PI,mrad:.18/Math.PI},WRITTEN=/^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[+-]?\d+)?)\s*(.*)$/i,DIGITS=12,GREATEST=1e300,tidy=value=>Number(value.toPrecision(
DIGITS)),written=value=>value==null?"":String(value).replace("-","−").replace("e−","e-");function quantity(text,{kind="number",unit:unit2="",optional=!1,least:least2=-1/0,
above=-1/0,below=1/0,whole=!1}={}){let plain=text.normalize("NFKC").replace(/[−–]/g,"-").replace(/[\u00a0\u2009\u202f]/g," ").trim(),example={length:unit2 in
LENGTHS?"12.5 or 0.5 in":"12.5",angle:"30 or 0.5 rad",number:"12.5"}[kind];if(!plain)return optional?{value:void 0}:{fault:`A number is missing here: write one \
such as ${example}.`};let found=WRITTEN.exec(plain);if(!found)return{fault:`“${text.trim()}” is not a number: write one such as ${example}.`};let number=Number(
found[1].replace(",",".")),name=found[2].trim().replace(/^μm$/,"µm"),factor=factorOf(name,kind,unit2);if(typeof factor=="string")return{fault:factor};let value=factor===
1?number:tidy(number*factor);if(!(Math.abs(value)<=GREATEST))return{fault:`${text.trim()} is too large a number.`};let shown2=kind==="angle"?"°":kind==="length"&&
unit2?` ${unit2}`:"";return whole&&!Number.isInteger(value)?{fault:`This has to be a whole number, such as ${Math.max(1,Math.round(value))}.`}:value<least2?{fault:`\
This may not be less than ${least2}${shown2}.`}:value<=above?{fault:`This must be greater than ${above}${shown2}.`}:value>=below?{fault:`This must be less than ${below}${shown2}\
.`}:{value}}function factorOf(name,kind,unit2){if(!name||kind==="length"&&name===unit2)return 1;if(kind==="number")return`“${name}” is not needed here: write \
the number alone.`;let units=kind==="angle"?ANGLES:LENGTHS,known=name in units?name:name.toLowerCase();return Object.hasOwn(units,known)?kind==="angle"?units[known]:
Object.hasOwn(LENGTHS,unit2)?units[known]/LENGTHS[unit2]:`This task has ${unit2?`the unit ${unit2}`:"no unit of length"}: write the number alone.`:`“${name}” \
is not a unit of ${kind} known here: write ${kind==="angle"?"° or rad":"mm, cm, m, in or ft"}, or the number alone.`}var made=0,NumberField=class{constructor({label,options,commit,step=()=>1,attributes={}}){made+=1,this.options=options,this.commit=commit,this.value=void 0,this.
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
altKey?.1:1),stepped=(value,by)=>Number((value+by).toPrecision(12)),labelled=(text,control,hint)=>h("label",{class:"bs-labelled"},h("span",{class:"bs-label"},text),
control,hint?h("span",{class:"bs-hint"},hint):null);function textField(label,commit,attributes={}){return h("input",{class:"bs-text",type:"text",autocomplete:"o\
ff",spellcheck:"false","aria-label":label,...attributes,onchange:event=>commit(event.target.value)})}function tick(text,commit,attributes={}){let box=h("input",
{type:"checkbox",...attributes,onchange:event=>commit(event.target.checked)});return{box,element:h("label",{class:"bs-tick"},box," ",text)}}function choice(label,pairs,commit,attributes={}){
return h("select",{class:"bs-choice","aria-label":label,...attributes,onchange:event=>commit(event.target.value)},pairs.map(([value,text])=>h("option",{value},text)))}
var button=(text,onclick,attributes={})=>h("button",{type:"button",class:"bm-button",onclick,...attributes},text);var KEY="burmester.studio.arrangement",LEAST=120,LEFT=160,STEP=24,kept=(()=>{try{return Object(JSON.parse(localStorage.getItem(KEY)??"{}"))}catch{return{}}})();
function remember(name,value){kept[name]=value;try{localStorage.setItem(KEY,JSON.stringify(kept))}catch{}}var resized=()=>dispatchEvent(new Event("resize"));function walkByArrows(group,which){
let all=()=>[...group.querySelectorAll(which)].filter(each2=>each2.checkVisibility()),stop=one=>{for(let each2 of group.querySelectorAll(which))put(each2,"tabin\
dex",each2===one?0:-1)};return group.addEventListener("focusin",({target})=>target instanceof Element&&target.matches(which)&&stop(target)),group.addEventListener(
"keydown",event=>{let there2=all(),at=there2.indexOf(event.target),last=there2.length-1,to={ArrowRight:at+1,ArrowDown:at+1,ArrowLeft:at-1,ArrowUp:at-1,Home:0,End:last}[event.
key];at<0||to===void 0||event.ctrlKey||event.metaKey||event.altKey||(event.preventDefault(),there2[(to+there2.length)%there2.length].focus())}),{stop,first:()=>stop(
group.querySelector(`${which}[aria-selected=true]`)??all()[0]??group.querySelector(which))}}function sidePanel(name,title,element,attributes={}){let fold=button(
"",()=>show(!panel.classList.contains("bs-folded"),!0),{class:"bs-fold","data-fold":name}),panel=h("section",{class:`bs-side bs-side-${name}`,"aria-label":title,
...attributes},fold,element),show=(folded,said=!1)=>{panel.classList.toggle("bs-folded",folded),put(fold,"aria-expanded",!folded),put(fold,"aria-label",`${folded?
"Show":"Hide"}: ${title}`),give(fold,"title",fold.getAttribute("aria-label")),fold.replaceChildren(h("span",{"aria-hidden":"true"},name==="left"===folded?"»":"\
«"),h("span",{class:"bs-fold-name","aria-hidden":"true"},title)),said&&(remember(`${name} folded`,folded),resized())};return show(kept[`${name} folded`]===!0),
panel}var Drawer=class{constructor(){this.tabs=new Map,this.list=h("div",{class:"bs-tabs",role:"tablist","aria-label":"Charts, maps and tables"}),this.grip=h("d\
iv",{class:"bs-grip",role:"separator",tabindex:0,"aria-orientation":"horizontal","aria-label":"Height of the drawer",title:"Drag to change the height"}),this.panels=
h("div",{class:"bs-drawer-panels",id:"bs-panels"}),this.element=h("section",{class:"bs-drawer","aria-label":"Charts, maps and tables"},this.grip,this.list,this.
panels),this.walk=walkByArrows(this.list,"[role=tab]"),this.listen(),this.setHeight(kept.height),this.open(null),addEventListener("beforeprint",()=>this.showAll(
!0)),addEventListener("afterprint",()=>this.showAll(!1))}add(name,title,element,isWanted=()=>!0){let tab=h("button",{type:"button",role:"tab",class:"bs-tab",id:`\
bs-tab-${name}`,"data-tab":name,"aria-controls":`bs-panel-${name}`,onclick:()=>this.open(this.shown===name?null:name,!0)},title),panel=h("section",{class:`bs-pa\
nel bs-panel-${name}`,id:`bs-panel-${name}`,role:"tabpanel",tabindex:0,"data-panel":name,"aria-labelledby":tab.id},h("h2",{},title),element);this.tabs.set(name,
{tab,panel,isWanted}),this.list.append(tab),this.panels.append(panel),this.open(this.shown??(kept.tab===name?name:null))}update(){for(let{tab,panel,isWanted}of this.
tabs.values())give(tab,"hidden",!isWanted()),panel.classList.toggle("bs-unwanted",tab.hidden);this.tabs.get(this.shown)?.tab.hidden&&this.open(null),this.walk.first()}open(name,said=!1){
this.shown=name;for(let[each2,{tab,panel}]of this.tabs)put(tab,"aria-selected",each2===name),give(panel,"hidden",each2!==name);this.element.classList.toggle("bs\
-closed",name===null),give(this.grip,"hidden",name===null),this.walk.first(),said&&remember("tab",name),resized()}showAll(on){this.element.classList.toggle("bs-\
on-paper",on);for(let[each2,{panel,tab}]of this.tabs)give(panel,"hidden",on?tab.hidden:each2!==this.shown)}setHeight(height){let most=Math.max(LEAST,innerHeight-
LEFT);this.height=clamp(Number.isFinite(height)?height:.34*innerHeight,LEAST,most),this.element.style.setProperty("--bs-height",`${Math.round(this.height)}px`);
for(let[name,value]of[["min",LEAST],["max",most],["now",this.height]])put(this.grip,`aria-value${name}`,Math.round(value))}listen(){let{grip}=this,take=height=>{
this.setHeight(height),remember("height",this.height),resized()},from=null;grip.addEventListener("pointerdown",event=>{event.preventDefault(),grip.setPointerCapture(
event.pointerId),from={y:event.clientY,height:this.height}}),grip.addEventListener("pointermove",event=>from&&take(from.height+from.y-event.clientY));for(let name of[
"pointerup","pointercancel"])grip.addEventListener(name,()=>from=null);grip.addEventListener("keydown",event=>{let by={ArrowUp:STEP,ArrowDown:-STEP}[event.key];
by&&(event.preventDefault(),take(this.height+by))})}};function sheets(root,all){let buttons=all.map(([name,title])=>button(title,()=>show(name,!0),{class:"bs-sh\
eet","data-sheet-of":name})),show=(name,said=!1)=>{all.forEach(([each2,,element],k)=>{element.classList.toggle("bs-below",each2!==name),put(buttons[k],"aria-pre\
ssed",each2===name)}),said&&(remember("sheet",name),resized())};return show(all.some(([name])=>name===kept.sheet)?kept.sheet:all[1][0]),h("div",{class:"bs-sheet\
s",role:"group","aria-label":"Beside the plane"},buttons)}var KEY2="burmester.studio",TAB="burmester.studio.tab",SOON=400,ROOM=1e6,Autosave=class{constructor(store){this.store=store,store.on("document chosen pinned fil\
ters picture",()=>this.soon()),store.connection.on("open",()=>this.isOpen&&this.soon()),addEventListener("pagehide",()=>this.keep()),document.addEventListener("\
visibilitychange",()=>document.visibilityState==="hidden"&&this.keep())}soon(){clearTimeout(this.timer),this.isOpen=!0,put(document.documentElement,"data-kept",
!1),this.timer=setTimeout(()=>this.keep(),SOON)}keep(){if(!this.isOpen)return;this.isOpen=!1,clearTimeout(this.timer);let{document:task,options,name,settings,picture,
filters,choice:choice2,history:history2,connection}=this.store,text={document:task,options,name,settings,picture};document.documentElement.dataset.kept="true";try{
sessionStorage.setItem(KEY2,JSON.stringify({...text,filters,choice:choice2,history:history2.kept(ROOM)}))}catch{}connection.post("/autosave",{...text,tab:tabName()},
"PUT").catch(()=>this.isOpen=!0)}};function tabName(){try{let name=sessionStorage.getItem(TAB)??crypto.randomUUID();return sessionStorage.setItem(TAB,name),name}catch{
return"tab"}}function keptHere(){try{let kept2=JSON.parse(sessionStorage.getItem(KEY2)??"null");return Array.isArray(kept2?.document?.poses)?kept2:null}catch{return null}}var ROLES={refused:"alert",offline:"alert",limit:"alert",ended:"alert",expired:"alert"},LONGEST_HELP=240,NO_FILE="task.json";function sentenceOf({code,message,where,
why,help}){return h("li",{},code?h("span",{class:"bm-code"},code):null," ",h("span",{},message),where&&!where.startsWith(NO_FILE)?h("pre",{class:"bs-where"},where):
null,why?h("p",{class:"bs-why"},`Why: ${why}.`):null,help?helpOf(help):null)}function helpOf(help){if(help.length<=LONGEST_HELP)return h("p",{class:"bs-help"},`\
What to do: ${help}.`);let end=help.slice(0,LONGEST_HELP).lastIndexOf("; "),cut=end>0?end:help.slice(0,LONGEST_HELP).lastIndexOf(" ");return h("div",{class:"bs-\
help"},h("p",{},`What to do: ${help.slice(0,cut)}${end>0?".":" …"}`),h("details",{},h("summary",{},"More"),h("p",{},`${help.slice(cut).replace(/^[; ]+/,"")}.`)))}
var Banners=class{files;constructor(store){this.store=store,this.shown=new Map,this.element=h("div",{class:"bs-banners"}),this.status=h("p",{class:"bs-status"}),
this.live=h("p",{class:"bs-unseen",role:"status"}),new ResizeObserver(()=>document.body.style.setProperty("--bs-banners",`${this.element.offsetHeight}px`)).observe(
this.element),store.on("messages",()=>this.messages()),store.on("state solved messages",()=>this.state())}say(kind,title,messages=[],{undo=!1,actions=[]}={}){let close=button(
"✕",()=>this.close(kind),{"aria-label":"Close",class:"bs-close"}),all=[...actions,...undo?[button("Undo",()=>(this.close(kind),this.store.undo()))]:[]],banner=h(
"section",{class:`bs-banner bs-${kind}`,role:ROLES[kind]??"status","data-banner":kind},h("p",{class:"bs-banner-title"},title),messages.length?h("ul",{},messages.
map(sentenceOf)):null,all.length?h("div",{class:"bs-row"},all):null,kind==="offline"?null:close);this.shown.get(kind)?.remove(),this.shown.set(kind,banner),this.
element.append(banner)}close(kind){this.shown.get(kind)?.remove(),this.shown.delete(kind)}messages(){let{store}=this,{messages}=store,[first]=messages;if(this.close(
"limit"),this.close("refused"),!first||store.document.poses.length<2)return;let shown2=store.solved?.linkages.length?" What is shown was followed from the answe\
r before.":"";first.tone==="cancelled"?this.say("note",`Solving was stopped.${shown2}`,[],{actions:[this.again()]}):first.tone==="limit"?this.say("limit",`Solvi\
ng took too long and was stopped. Nothing of the task is lost.${shown2}`,messages,{actions:[this.again()]}):first.tone==="ended"?this.say("ended","The process t\
hat computes for this page has ended. Nothing of the task is lost.",messages,{actions:[this.again()]}):this.say("refused","The task cannot be solved as it is.",
messages)}again(){return button("Solve again",()=>{this.close("note"),this.close("limit"),this.close("ended"),this.store.solve()},{"data-do":"solve-again"})}state(){
let{store}=this,solving=store.state==="solving";if(store.state==="offline"?this.offline():this.close("offline"),put(this.status,"data-state",store.state),store.
state==="dragging")return;let said=store.state==="offline"?"Not connected":this.summary();say(this.status,solving?`Solving${store.progress?`: ${store.progress}`:
"…"}`:said),!solving&&said&&say(this.live,said)}summary(){let{solved,solvedFor,document:document2,messages}=this.store;if(document2.poses.length<2)return"Two \
poses or more make a task";if(messages.length)return"Not solved";if(!solved||solvedFor!==document2)return"";let count=solved.linkages.length,usable=solved.linkages.
filter(each2=>each2.usable).length;return count?`${count} linkage${count===1?"":"s"}, ${usable} usable`:"No linkage"}offline(){this.shown.has("offline")||this.say(
"offline","The server does not answer. Nothing is lost: the task is in this page, and can still be changed and saved.",[],{actions:[button("Save the task (JSON)",
()=>this.files.saveWithoutServer(),{"data-do":"save-json"}),h("span",{class:"bs-hint"},"The page tries again by itself. If the server has ended, start burmester\
 studio with that file, or drop the file on the new page.")]})}expired(){this.close("offline"),this.say("expired","The server was started anew. Nothing is lost:\
 open the address that it printed in this tab, and go on here.",[],{actions:[button("Save the task (JSON)",()=>this.files.saveWithoutServer())]})}};var AXIS=26,BLOCK=[22,14],transform=(x,y,angle)=>`translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;function foot(){let hatch="";for(let k=-2;k<=2;k+=
1)hatch+=`M${5.5*k+3} 16l-6 7`;return s("g",{class:"bm-foot"},s("path",{class:"bm-solid",d:"M0 0L-10 16H10Z"}),s("path",{class:"bm-ground",d:`M-16 16H16${hatch}`}))}
function axes(length){let l=length,head2=Math.max(4,.22*length);return`M0 0H${l}m${-head2} ${-head2/2}l${head2} ${head2/2}l${-head2} ${head2/2}M0 0V${-.6*l}`}function polyline(points,view){
let path2="",pen="M";for(let[x,y]of points){if(!Number.isFinite(x)||!Number.isFinite(y)){pen="M";continue}path2+=`${pen}${px(view.X(x))} ${px(view.Y(y))}`,pen="\
L"}return path2}function hull(points){let sorted=[...points].sort((p,q)=>p[0]-q[0]||p[1]-q[1]),half=list=>{let kept2=[];for(let point2 of list){for(;kept2.length>
1;){let[a,b]=kept2.slice(-2);if((b[0]-a[0])*(point2[1]-a[1])-(b[1]-a[1])*(point2[0]-a[0])>0)break;kept2.pop()}kept2.push(point2)}return kept2.slice(0,-1)},corners=[
...half(sorted),...half(sorted.reverse())];return corners.length?corners:sorted.slice(0,1)}function act(place,[x,y]){let c=Math.cos(place.a),d=Math.sin(place.a);return[place.x+c*x-d*y,place.y+d*x+c*y]}function back(place,[x,y]){let c=Math.cos(place.a),
d=Math.sin(place.a);return[c*(x-place.x)+d*(y-place.y),-d*(x-place.x)+c*(y-place.y)]}var normalOf=dyad=>{let angle=radians(dyad.line.normal_deg);return[Math.cos(
angle),Math.sin(angle)]};function constraint(dyad,place){if(dyad.kind==="PP"){let away2=place.a-radians(dyad.angle_deg);return[away2-2*Math.PI*Math.round(away2/
(2*Math.PI)),0,0,1]}if(dyad.kind==="RP"){let[nx2,ny2]=normalOf(dyad),c=Math.cos(place.a),d=Math.sin(place.a),tx=c*nx2-d*ny2,ty=d*nx2+c*ny2,ax=dyad.fixed_pivot[0]-
place.x,ay=dyad.fixed_pivot[1]-place.y;return[tx*ax+ty*ay-dyad.line.offset,-tx,-ty,tx*ay-ty*ax]}let[x,y]=act(place,dyad.moving_pivot),nx,ny,residual;if(dyad.kind===
"RR"){let ax=x-dyad.fixed_pivot[0],ay=y-dyad.fixed_pivot[1],size2=Math.hypot(ax,ay)||1;[nx,ny,residual]=[ax/size2,ay/size2,size2-dyad.radius]}else[nx,ny]=normalOf(
dyad),residual=nx*x+ny*y-dyad.line.offset;return[residual,nx,ny,(x-place.x)*ny-(y-place.y)*nx]}var gradient=(dyad,place)=>constraint(dyad,place).slice(1);function project(dyads,place,length){
let{x,y,a}=place;for(let step=0;step<4;step+=1){let[f,...p]=constraint(dyads[0],{x,y,a}),[g,...q]=constraint(dyads[1],{x,y,a});p[2]/=length,q[2]/=length;let pp=p[0]*
p[0]+p[1]*p[1]+p[2]*p[2],pq=p[0]*q[0]+p[1]*q[1]+p[2]*q[2],qq=q[0]*q[0]+q[1]*q[1]+q[2]*q[2],det=pp*qq-pq*pq;if(!(det>1e-9*pp*qq))return{x,y,a};let u=(f*qq-g*pq)/
det,v=(g*pp-f*pq)/det;if(x-=u*p[0]+v*q[0],y-=u*p[1]+v*q[1],a-=(u*p[2]+v*q[2])/length,Math.abs(f)+Math.abs(g)<1e-14*length)break}return{x,y,a}}function catmullRom(values,i,share,round){
let last=values.length-1,at=k=>{if(k>=0&&k<=last)return values[k];if(!round)return k<0?2*values[0]-values[-k]:2*values[last]-values[2*last-k];let wrap=k<0?k+last:
k-last;return values[wrap]+(k<0?-1:1)*(values[last]-values[0])},[p,q,r,t]=[at(i-1),at(i),at(i+1),at(i+2)];return q+share/2*(r-p+share*(2*p-5*q+4*r-t+share*(3*(q-
r)+t-p)))}function placeAt(linkage,way,u,length){if(way.joints)return placeOfJoints(linkage,way,way.joints,u);let stop=linkage.pose_errors.find(row=>row.at===way&&
Math.abs(row.frame-u)<1e-6);if(stop)return{x:stop.x,y:stop.y,a:radians(stop.angle_deg)};let i=clamp(Math.floor(u),0,way.x.length-2),share=u-i,place={x:catmullRom(
way.x,i,share,way.round),y:catmullRom(way.y,i,share,way.round),a:catmullRom(way.angle,i,share,way.round)};return project(linkage.led,place,length)}function placeOfJoints({
ground},way,moving,u){let at=values=>smooth(values,u),joints={...ground};for(let[name,[x,y]]of Object.entries(moving))joints[name]=[at(x),at(y)];return{x:at(way.
x),y:at(way.y),a:at(way.angle),joints}}function smooth(values,u){let count=Math.min(6,values.length),first=clamp(Math.floor(u)-2,0,values.length-count),sum=0;for(let j=0;j<
count;j+=1){let weight=1;for(let k=0;k<count;k+=1)k!==j&&(weight*=(u-first-k)/(j-k));sum+=weight*values[first+j]}return sum}function linear(values,u){let i=clamp(
Math.floor(u),0,values.length-2),share=u-i,before=values[i],after=values[i+1];if(before===null||after===null)return null;let value=before+share*(after-before);return Number.
isNaN(value)?null:value}function valueAt({x,y,stems=!1},at){if(at===null)return null;let here=x.findIndex(each2=>Math.abs(each2-at)<1e-6);return here>=0?y[here]:
stems||!(at>x[0]&&at<x[x.length-1])?null:linear(y,frameAt(x,at))}function frameAt(values,wanted){let low=0,high=values.length-1;if(wanted<=values[low])return low;
if(wanted>=values[high])return high;for(;high-low>1;){let middle2=low+high>>1;values[middle2]<=wanted?low=middle2:high=middle2}let step=values[high]-values[low];
return low+(step>0?(wanted-values[low])/step:0)}var COILS=9,LEAD=.15,BARREL=.6,HALF_WIDTH=6,LEAST_ARROW=16,LONGEST_ARROW=62,RADIUS=11,TURNS=2.25,LONGEST_FORCE=90,LEAST_FORCE=2,BARB=[9,4.5];function springPath(kind,[
x,y],[u,v]){let length=Math.hypot(u-x,v-y)||1,across=[-HALF_WIDTH*(v-y)/length,HALF_WIDTH*(u-x)/length],at=(share,side)=>`${px(x+share*(u-x)+side*across[0])} ${px(
y+share*(v-y)+side*across[1])}`;if(kind==="constant")return`M${at(0,0)}L${at(1,0)}`;if(kind==="gas")return`M${at(0,1)}L${at(BARREL,1)}L${at(BARREL,-1)}L${at(0,-1)}\
ZM${at(BARREL,0)}L${at(1,0)}`;let teeth=Array.from({length:2*COILS+1},(_,k)=>at(LEAD+(1-2*LEAD)*k/(2*COILS),k%(2*COILS)?k%2?1:-1:0));return`M${[at(0,0),...teeth,
at(1,0)].join("L")}`}function roundPath(kind,[x,y]){return kind!=="torsion"?`M${px(x-RADIUS)} ${px(y)}a${RADIUS} ${RADIUS} 0 1 0 ${2*RADIUS} 0a${RADIUS} ${RADIUS}\
 0 1 0 ${-2*RADIUS} 0h${2*RADIUS}M${px(x)} ${px(y-RADIUS)}v${2*RADIUS}`:`M${Array.from({length:55},(_,k)=>[k/54*RADIUS,k/54*2*Math.PI*TURNS]).map(([r,turn])=>`${px(
x+r*Math.cos(turn))} ${px(y-r*Math.sin(turn))}`).join("L")}`}function markPoints({loads},places){if(!loads)return[];let ends=loads.springs.flatMap(spring=>spring.
ends),on=name=>ends.filter(({link})=>link===name).map(({point:point2})=>point2);return[...on("ground"),...places.flatMap(place=>[...on("body"),...loads.hand?[loads.
hand]:[]].map(point2=>act(place,point2)))]}function arrowPath([x,y],angle,length){let c=Math.cos(angle),d=-Math.sin(angle),tip=[x+length*c,y+length*d],barb=side=>`${px(
tip[0]-BARB[0]*c-side*BARB[1]*d)} ${px(tip[1]-BARB[0]*d+side*BARB[1]*c)}`;return`M${px(x)} ${px(y)}L${tip.map(px).join(" ")}M${barb(1)}L${tip.map(px).join(" ")}\
L${barb(-1)}`}var LoadMarks=class{constructor(){this.springs=s("g",{class:"bm-springs"}),this.hand=s("path",{class:"bm-hand"}),this.forces=s("g",{class:"bm-pin-\
forces"}),this.group=s("g",{class:"bm-loads"},this.springs,this.hand,this.forces)}shape(data,linkage,view){this.view=view,this.loads=data.loads??null,this.known=
(linkage.followed?null:linkage.loads)??null;let springs=this.loads?.springs??[];for(;this.springs.children.length>springs.length;)this.springs.lastChild?.remove();
for(;this.springs.children.length<springs.length;)this.springs.append(s("g",{},s("path",{class:"bm-spring"}),s("circle",{class:"bm-spring-end",r:2.6}),s("circle",
{class:"bm-spring-end",r:2.6})));springs.forEach(({kind,ends},k)=>{let[,...marks]=this.springs.children[k].children;put(this.springs.children[k],"data-spring",kind);
for(let mark of marks)put(mark,"visibility",ends.length>1?"inherit":"hidden")});let pins=this.known?.pins??[];this.greatest=Math.max(0,...pins.flatMap(({force:[
x,y]})=>x.map((each2,i)=>each2===null||y[i]===null?0:Math.hypot(each2,y[i])))),this.forces.replaceChildren(...pins.map(({name})=>s("g",{"data-pin":name},s("path",
{class:"bm-pin-force"}),s("text",{class:"bm-pin-newtons"}))))}show(place,drive){let{loads,view}=this;if(!loads||!view){put(this.hand,"d","");return}loads.springs.
forEach(({kind,ends},k)=>{let at=ends.map((end,j)=>this.endOf(end,k,j,place,drive)),group=this.springs.children[k];put(group,"visibility",at.every(Boolean)?"inh\
erit":"hidden"),at.every(Boolean)&&(put(group.children[0],"d",at.length>1?springPath(kind,at[0],at[1]):roundPath(kind,at[0])),at.forEach(([x,y],j)=>{put(group.children[j+
1],"cx",px(x)),put(group.children[j+1],"cy",px(y))}))}),(this.known?.pins??[]).forEach((pin,k)=>this.showForce(this.forces.children[k],pin,drive));let pushes=this.
known?.hand,angle=pushes&&drive!==null?valueAt(pushes,drive):null;if(!loads.hand||angle===null)put(this.hand,"d","");else{let force=valueAt({x:pushes.x,y:pushes.
force},drive)??0,size2=LEAST_ARROW+(LONGEST_ARROW-LEAST_ARROW)*Math.abs(force);put(this.hand,"d",arrowPath(this.seen(act(place,loads.hand)),force<0?angle+Math.PI:
angle,size2))}}showForce(group,{at,force},drive){let place=drive===null?[null]:at.map(each2=>valueAt(each2,drive)),[x,y]=drive===null?[null,null]:force.map(each2=>valueAt(
{x:at[0].x,y:each2},drive)),known=place.every(each2=>each2!==null)&&x!==null&&y!==null,size2=known?Math.hypot(x,y):0,long=this.greatest?LONGEST_FORCE*size2/this.
greatest:0;if(put(group,"visibility",long>LEAST_FORCE?"inherit":"hidden"),!(long>LEAST_FORCE))return;let from=this.seen(place),c=x/size2,d=y/size2;put(group.children[0],
"d",arrowPath(from,Math.atan2(y,x),long)),put(group.children[1],"x",px(from[0]+(long+6)*c)),put(group.children[1],"y",px(from[1]-(long+6)*d+4)),put(group.children[1],
"text-anchor",c<-.3?"end":c>.3?"start":"middle"),group.children[1].textContent=`${group.dataset.pin} ${Number(size2.toPrecision(3))} N`}seen([x,y]){let{view}=this;
return view?[view.X(x),view.Y(y)]:[0,0]}endOf({link,point:point2},spring,end,place,drive){if(link==="ground")return this.seen(point2);if(link==="body")return this.
seen(act(place,point2));let known=this.known?.moved.find(each2=>each2.spring===spring&&each2.end===end),at=known&&drive!==null?known.at.map(each2=>valueAt(each2,
drive)):[null];return at.some(each2=>each2===null)?null:this.seen(at)}};var LONGEST_STEP=.015,MOST_BETWEEN=40,LEAST_STRETCH=1e-6;function stretchOf(linkage,index,whole=!1){let last=(linkage?.ways[index]?.x.length??2)-1,frames=linkage.
pose_errors.filter(row=>row.way===index).map(row=>row.frame),low=frames.reduce((a,b)=>Math.min(a,b),last),high=frames.reduce((a,b)=>Math.max(a,b),0),isApart=high-
low>LEAST_STRETCH,sense=frames[frames.length-1]<frames[0]?-1:1;return{...isApart&&!whole?{low,high}:{low:0,high:last},sense,isApart}}var placesOf=(data,linkage,way,stretch)=>placesAlong(
data,stretch,u=>Number.isInteger(u)&&!way.joints?{x:way.x[u],y:way.y[u],a:way.angle[u]}:placeAt(linkage,way,u,data.chart.length));function placesAlong(data,{low,
high},at){let places=[at(low)],before=low,goTo=u=>{let next=at(u),last=places[places.length-1],count=Math.min(MOST_BETWEEN,Math.floor(Math.hypot(next.x-last.x,next.
y-last.y)/(LONGEST_STEP*data.scene)));for(let k=1;k<=count;k+=1)places.push(at(before+k/(count+1)*(u-before)));places.push(next),before=u};for(let k=Math.floor(
low)+1;k<high;k+=1)goTo(k);return goTo(high),places}function driveAtTime({time:{x,y}},time){return y[0]<=y[y.length-1]?valueAt({x:y,y:x},time):valueAt({x:[...y].
reverse(),y:[...x].reverse()},time)}function alongLine(dyad,place){let[nx,ny]=normalOf(dyad),[x,y]=dyad.kind==="PR"?act(place,dyad.moving_pivot):back(place,dyad.
fixed_pivot);return nx*y-ny*x}function travelOf(dyad,places){let along2=places.map(place=>alongLine(dyad,place));return[along2.reduce((a,b)=>Math.min(a,b)),along2.
reduce((a,b)=>Math.max(a,b))]}function pointOnLine(dyad,along2){let[nx,ny]=normalOf(dyad),{offset}=dyad.line;return[offset*nx-along2*ny,offset*ny+along2*nx]}var WIDEST=4,ROOM2=2.5,SPARE=.75,LEAST2=.25,MOST_PLACES=400,INSET=12,bounds=points=>points.reduce(([x,y,u,v],[a,b])=>Number.isFinite(a+b)?[Math.min(x,a),Math.min(
y,b),Math.max(u,a),Math.max(v,b)]:[x,y,u,v],[1/0,1/0,-1/0,-1/0]),placesAtPoses=(data,linkage)=>data.poses.flatMap((pose,k)=>{let row=linkage?.pose_errors[k],at=row&&
row.x!==null?row:pose;return at.angle_deg===null?[]:[{x:at.x,y:at.y,a:radians(at.angle_deg),k}]});function farFrom(data){let[x,y,u,v]=bounds(data.poses.map(pose=>[
pose.x,pose.y])),reach=(data.body??[]).reduce((most,[a,b])=>Math.max(most,Math.hypot(a,b)),0);return point2=>!(Math.hypot(point2[0]-(x+u)/2,point2[1]-(y+v)/2)<Math.
max(WIDEST*data.scene,reach))}function pivotsAt(linkage,places){let fixed2=linkage.led.flatMap(dyad=>dyad.fixed_pivot?[dyad.fixed_pivot]:[]),own=linkage.led.flatMap(
dyad=>dyad.moving_pivot?[dyad.moving_pivot]:dyad.kind==="RP"&&places.length?travelOf(dyad,places).map(end=>pointOnLine(dyad,end)):[]);return[...fixed2,...places.
flatMap(place=>[...own.map(point2=>act(place,point2)),...Object.values(place.joints??{})])]}function nearPoints(data,linkage,places,{far=!1,close=!1}={}){let isFar=farFrom(
data),seen2=point2=>far||!isFar(point2),reached=linkage?[...linkage.pose_errors.filter(row=>row.x!==null),...places]:[],points=[...[...data.poses,...reached].map(
({x,y})=>[x,y]),...linkage?[...pivotsAt(linkage,places),...markPoints(data,places)]:[]],some2=places.filter((place,k)=>k%Math.ceil(places.length/MOST_PLACES)===
0&&seen2([place.x,place.y])),corners=data.body&&!close?[...placesAtPoses(data,linkage),...some2].flatMap(place=>data.body.map(corner=>act(place,corner))):[];return[
...points.filter(seen2),...corners]}function fitted(near2,others,whole){let all=bounds([...near2,...others]),[x,y,u,v]=bounds(near2),size2=Math.max(u-x,v-y)||1,
reach=SPARE*size2;return whole||!near2.length||Math.max(all[2]-all[0],all[3]-all[1])<=ROOM2*size2?all:[Math.max(all[0],x-reach),Math.max(all[1],y-reach),Math.min(
all[2],u+reach),Math.min(all[3],v+reach)]}function boxOf(data,linkage,places,{whole=!1,close=!1}={}){let near2=nearPoints(data,linkage,places,{far:whole,close}),
regions=close?[]:data.keep_out.flatMap(region=>region.outline),box=fitted(near2,regions,whole||!linkage),least2=LEAST2*data.scene;for(let k of[0,1]){let lack=Math.
max(0,least2-(box[k+2]-box[k]));box[k]-=lack/2,box[k+2]+=lack/2}return box}function viewOf(box,width,height,margin){let scale=Math.min((width-2*margin)/(box[2]-
box[0]),(height-2*margin)/(box[3]-box[1])),left=width/2-scale*(box[0]+box[2])/2,top=height/2+scale*(box[1]+box[3])/2;return{scale,left,top,width,height,X:x=>left+
scale*x,Y:y=>top-scale*y}}function edgeTowards({X,Y,width,height},at){let x=X(at[0]),y=Y(at[1]),cx=width/2,cy=height/2;if(x>=0&&y>=0&&x<=width&&y<=height)return null;
let size2=Math.hypot(x-cx,y-cy),u=(x-cx)/size2,v=(y-cy)/size2,reach=Math.min((cx-INSET)/Math.abs(u),(cy-INSET)/Math.abs(v));return{x:cx+reach*u,y:cy+reach*v,angle:Math.
atan2(-v,u)}}var MOST_NAMES=24,NAME_STEP=5,MOST_ROWS=40,NONE="–";function table(caption,heads,rows,attributes){return h("div",{class:"bm-scroll",tabindex:"0",role:"region",
"aria-label":caption},h("table",attributes,h("caption",{},caption),h("thead",{},h("tr",{},heads.map(head2=>h("th",{scope:"col",class:head2.text?"bm-words":null},
head2.name??head2)))),h("tbody",{},rows)))}function longTable(caption,heads,rows,attributes){let first=table(caption,heads,rows.slice(0,MOST_ROWS),attributes),others=rows.
slice(MOST_ROWS);return others.length?h("div",{class:"bm-long"},first,h("details",{class:"bm-every"},h("summary",{},`${others.length} more`),table(`${caption}, \
from ${MOST_ROWS+1}`,heads,others,attributes))):first}var cells=(values,words=[],heads=[])=>values.map((value,k)=>k===0?h("th",{scope:"row"},value):h("td",{class:classes(
words.includes(k)&&"bm-words",(value??NONE)===NONE&&"bm-none"),"data-head":heads[k]?.name??heads[k]},value??NONE)),classes=(...names)=>names.filter(Boolean).join(
" ")||null,UNIT_NAMES={in:"inches",ft:"feet"},inUnit=data=>data.unit?`, in ${UNIT_NAMES[data.unit]??data.unit}`:"",unitOf=data=>data.unit?` (${data.unit})`:"",decimalsOf=data=>clamp(
4-Math.ceil(Math.log10(data.scene)),0,12),poseName=pose=>pose.label===pose.name?pose.name:`${pose.label}: ${pose.name}`,isPoint=pose=>pose.angle_deg===null,nounOf=({
poses,stop=void 0})=>stop??(poses.length&&poses.every(isPoint)?"point":"pose"),isNamed=({path:path2,poses},k)=>!path2||poses.length<=MOST_NAMES||k===0||(k+1)%NAME_STEP===
0,calledOf=pose=>pose.called??`${isPoint(pose)?"point":"pose"} ${poseName(pose)}`,shortened=(text,most)=>text.length>most?`${text.slice(0,most-1).trimEnd()}…`:
text;function missOf(position,angle,unit2){if(position==="-")return"–";let[away2,...share]=position.split(" ("),length=[away2==="exact"?away2:`${away2}${unit2}`,
...share].join(" (");return angle==="free"||position==="exact"&&angle==="exact"?length:`${length} and ${angle}`}function dyadTable(data){let misses=data.poses.some(
isPoint)?[]:["rms miss","worst miss"],heads=["",{name:"kind",text:!0},"on the ground (F)","on the body (M)",`length${unitOf(data)}`,...misses],rows=data.dyads.map(
dyad=>h("tr",{},cells([dyad.id,dyad.kind,dyad.said.ground,dyad.said.body,dyad.said.length,...misses.length?[dyad.said.rms,dyad.said.worst]:[]],[1],heads)));return longTable(
data.dyads_title,heads,rows,{class:"bm-stacks"})}function worded(data,{caption,heads,words=[],rows,...how}){let named=heads.map((name,k)=>words.includes(k)?{name,
text:!0}:name),lines=cell=>Array.isArray(cell)?cell.map(part=>h("span",{class:"bm-line-of"},part)):cell,made2=longTable(caption+(how.lengths?inUnit(data):""),named,
rows.map(row=>h("tr",{},cells(row.map(lines),words,named))),{class:how.class});return how.folded?h("details",{class:"bm-every"},h("summary",{},how.folded),made2):
made2}function dimensionRows(linkage){let uncertain=linkage.said.dimensions.some(row=>row.give),last=null;return linkage.said.dimensions.map(row=>{let name=row.
dyad===last?"":row.dyad;last=row.dyad;let side=linkage.led.findIndex(dyad=>dyad.id===row.dyad);return h("tr",{},h("th",{scope:"row",class:name?`bm-side${side}`:
null},name),h("td",{class:"bm-words"},row.what),h("td",{},row.value),uncertain?h("td",{},row.give):null)})}function dimensionTable(data,linkage){return table(`D\
imensions of ${linkage.id}${inUnit(data)}`,["",{name:"",text:!0},"value",...linkage.said.dimensions.some(row=>row.give)?["± (95 %)"]:[]],dimensionRows(linkage),
{class:"bm-dimensions"})}function poseTable(data,linkage){let digits=decimalsOf(data),unit2=unitOf(data),noun=nounOf(data),turned=noun!=="point",ifTurned=value=>turned?[value]:[],heads=[
noun,"wanted x",`y${unit2}`,...ifTurned("angle")];linkage&&heads.push("body x",`y${unit2}`,"angle","off by",...ifTurned("turned by"),...linkage.columns?.map(([head2])=>head2)??
["transm."],{name:"where",text:!0});let rows=data.poses.map((pose,k)=>{let values=[poseName(pose)+(pose.exact?" (exact)":""),fixed(pose.x,digits),fixed(pose.y,digits),
...ifTurned(isPoint(pose)?"free":`${fixed(pose.angle_deg,2)}°`)];if(linkage){let row=linkage.pose_errors[k];values.push(fixed(row.x,digits),fixed(row.y,digits),
row.angle_deg===null?"–":`${fixed(row.angle_deg,2)}°`,row.said.position,...ifTurned(row.said.turned),...linkage.columns?.map(([,texts])=>texts[k])??[row.said.
transmission],row.way===null?"–":wayName(linkage.ways[row.way],linkage))}return h("tr",{"data-pose":k+1},cells(values,[heads.length-1]))}),what=turned?"Poses":
"Points";return table(linkage?`${what}, and where ${linkage.id} takes the body`:what,heads,rows,{class:data.poses.some(pose=>pose.label!==pose.name)?"bm-pose-ta\
ble bm-named":"bm-pose-table"})}function imageTables(data,linkage){let digits=decimalsOf(data),rows=data.poses.filter(pose=>!isPoint(pose)).map(pose=>{let c=Math.
cos(pose.angle_deg*Math.PI/360),d=Math.sin(pose.angle_deg*Math.PI/360),z=[(pose.x*d-pose.y*c)/2,(pose.x*c+pose.y*d)/2,d,c];return h("tr",{},cells([pose.label,...z.
map((value,k)=>fixed(value,k<2?digits:5))]))}),points=rows.length?[table(`Image points of the poses${unitOf(data)}, Z3² + Z4² = 1`,["pose","Z1","Z2","Z3","Z4"],
rows)]:[];if(!linkage)return points;let surfaces=linkage.led.map((dyad,k)=>h("tr",{},cells([dyad.id,...linkage.said.manifolds[k]]))),heads=["",...[1,2,3,4,5,6,7,
8].map(k=>`p${k}`)];return[...points,table("Surfaces: p1 (Z1² + Z2²) + p2 Z3² + p3 Z1 Z3 + p4 Z2 Z3 + p5 Z1 Z4 + p6 Z2 Z4 + p7 Z3 Z4 + p8 Z4² = 0",heads,surfaces)]}
function wayName(way,linkage){let circuits=new Set(linkage.ways.map(each2=>each2.circuit)).size,parts=[];return(circuits>1||way.branches<2)&&parts.push(`assembl\
y ${way.circuit}`),way.branches>1&&parts.push(`branch ${way.branch}`),parts.join(", ")}var HATCH=9,PALEST=.45,LONGEST_NAME=28,MANY_GHOSTS=6,patterns=0,closed=(points,view,[x,y])=>`M${points.map(each2=>`${px(x+view.scale*each2[0])} ${px(y-view.scale*
each2[1])}`).join("L")}Z`,bodyOutline=(data,view)=>closed(data.body,view,[0,0]),hasGhost=(k,count)=>count<=MANY_GHOSTS||k===0||k===count-1;function ghosts(data,linkage,view){
let group=s("g",{class:"bm-ghosts"});if(!data.body){for(let row of linkage?.drawn?linkage.pose_errors.filter((_,k)=>hasGhost(k,linkage.pose_errors.length)):[])group.
append(plate(placeAt(linkage,linkage.ways[row.way],row.frame,data.chart.length),linkage,view));return group}let last=Math.max(1,data.poses.length-1);for(let{x,y,
a,k}of placesAtPoses(data,linkage).filter(place=>!linkage||hasGhost(place.k,data.poses.length))){let opacity=(PALEST+(1-PALEST)*k/last).toFixed(3);group.append(
s("path",{class:"bm-ghost",d:bodyOutline(data,view),"data-pose":k+1,opacity,transform:transform(view.X(x),view.Y(y),a)}))}return group}var plate=(place,{drawn},view)=>s(
"path",{class:"bm-ghost",d:`${polyline([...drawn.find(({kind})=>kind==="carried").joints].map(joint=>place.joints[joint]??[place.x,place.y]),view)}Z`});function keepOut(data,view){
let group=s("g",{class:"bm-keep-out"});if(!data.keep_out.length)return group;let id=`bm-hatch-${patterns+=1}`;group.append(s("defs",{},s("pattern",{id,width:HATCH,
height:HATCH,patternUnits:"userSpaceOnUse",patternTransform:"rotate(45)"},s("path",{class:"bm-hatch",d:`M0 0V${HATCH}`}))));for(let region of data.keep_out){let d=closed(
region.outline,view,[view.left,view.top]);group.append(s("g",{class:"bm-region"},s("title",{},region.name||"keep out"),s("path",{class:"bm-region-plain",d}),s("\
path",{class:"bm-region-edge",d,fill:`url(#${id})`})))}return group}function keepOutNames(data,view,labels){return data.keep_out.filter(({name})=>name).map(({name,
at:[x,y]})=>{let text=shortened(name,LONGEST_NAME);return labels.block(view.X(x),view.Y(y),7.2*text.length,14),s("text",{class:"bm-region-name",x:px(view.X(x)),
y:px(view.Y(y)+4),"text-anchor":"middle"},text)})}function withKeys(object,changes){let copy={...object,...changes};for(let[key,value]of Object.entries(changes))value===void 0&&delete copy[key];return copy}var replaced=(list,index,value)=>list.
map((each2,k)=>k===index?value:each2),without=(list,index)=>list.filter((_,k)=>k!==index),inserted=(list,index,value)=>[...list.slice(0,index),value,...list.slice(
index)],withList=(document2,key,list)=>withKeys(document2,{[key]:list.length?list:void 0}),filled=table3=>Object.keys(table3).length?table3:void 0,EXACT={x:0,y:0,
angle_deg:0},FEWEST_TRACED=10,isFree=(pose,key)=>!!pose?.free?.includes(key)||pose?.tolerance?.[key]==="free",isPoint2=pose=>isFree(pose,"angle"),isOfPoints=({poses})=>poses.
length>0&&poses.every(isPoint2),isPath=document2=>isOfPoints(document2)&&(document2.path!==void 0||document2.poses.length>=FEWEST_TRACED),setPath=(document2,changes)=>withKeys(
document2,{path:withKeys(document2.path??{closed:!1},changes)}),setUsual=(document2,key,value)=>withKeys(document2,{tolerance:{...EXACT,...document2.tolerance,[key]:value??
0}}),pathDocument=(document2,points,closed2)=>withKeys(document2,{poses:points.map(([x,y])=>({x,y,free:["angle"]})),path:{closed:closed2},tolerance:isOfPoints(document2)?
document2.tolerance??EXACT:EXACT}),isExact=tolerance=>tolerance&&["x","y","angle_deg"].every(key=>!tolerance[key]);function settled(document2){let{poses,path:path2,
tolerance}=document2,some2=poses.some(pose=>pose.free?.length);return withKeys(document2,{path:path2&&poses.length&&!poses.every(isPoint2)?void 0:path2,tolerance:some2?
tolerance??EXACT:isExact(tolerance)?void 0:tolerance})}var withCrank=(document2,change)=>document2.path?.crank_deg?setPath(document2,{crank_deg:change(document2.
path.crank_deg)}):document2;function betweenCranks(angles,index){let[a,b]=[angles[index-1],angles[index]];return a!==void 0&&b!==void 0?(a+b)/2:a===void 0?(b??0)-
10:a+(a-(angles[index-2]??a-10))}var setPose=(document2,index,changes)=>withKeys(document2,{poses:replaced(document2.poses,index,withKeys(document2.poses[index],
changes))}),addPose=(document2,pose,index=document2.poses.length)=>settled(withCrank(withKeys(document2,{poses:inserted(document2.poses,index,pose)}),angles=>inserted(
angles,index,betweenCranks(angles,index)))),removePose=(document2,index)=>settled(withCrank(withKeys(document2,{poses:without(document2.poses,index)}),angles=>without(
angles,index))),removePoses=(document2,indices)=>[...indices].sort((a,b)=>b-a).reduce(removePose,document2);function setAngle(document2,index,angle){let free=angle===
void 0,same=isPoint2(document2.poses[index])===free;return setPose(same?document2:setFree(document2,index,"angle",free),index,{angle})}var setCrank=(document2,index,angle)=>withCrank(
document2,angles=>replaced(angles,index,angle)),duplicatePose=(document2,index)=>addPose(document2,withKeys(document2.poses[index],{name:void 0}),index+1);function movePose(document2,from,to){
let moved2=list=>inserted(without(list,from),to,list[from]);return withCrank(withKeys(document2,{poses:moved2(document2.poses)}),moved2)}function setFree(document2,index,component2,free){
let pose=document2.poses[index],others=(pose.free??[]).filter(each2=>each2!==component2),list=free?[...others,component2]:others,{[component2]:_,[component2==="\
angle"?"angle_deg":component2]:bound,...bounds2}=pose.tolerance??{};return settled(setPose(document2,index,{free:list.length?list:void 0,tolerance:free||pose.tolerance?.[component2]===
"free"?filled(bounds2):pose.tolerance}))}var setTolerance=(document2,index,key,bound)=>setPose(document2,index,{tolerance:filled(withKeys(document2.poses[index].
tolerance??{},{[key]:bound}))}),setBody=(document2,corners)=>withList(document2,"body",corners),bodyOf=document2=>Array.isArray(document2.body)?document2.body:[],
regionsOf=document2=>document2.keep_out===void 0?[]:[document2.keep_out].flat(),addRegion=(document2,region)=>withList(document2,"keep_out",[...regionsOf(document2),
region]),setRegion=(document2,index,changes)=>withList(document2,"keep_out",replaced(regionsOf(document2),index,withKeys(regionsOf(document2)[index],changes))),
removeRegion=(document2,index)=>withList(document2,"keep_out",without(regionsOf(document2),index)),setSurrounding=(document2,key,value)=>withKeys(document2,{surroundings:filled(
withKeys(document2.surroundings??{},{[key]:value}))}),limitsOf=document2=>document2.limits===void 0?[]:[document2.limits].flat();function setLimit(document2,index,changes){
let tables=limitsOf(document2),changed2=withKeys(tables[index]??{},changes),all=index<tables.length?replaced(tables,index,changed2):[...tables,changed2],kept2=all.
length>1||filled(changed2)?all:[];return withKeys(document2,{limits:kept2.length>1?kept2:kept2[0]})}function splitLimits(document2,apart){let tables=limitsOf(document2);
return apart?tables.length>1?document2:withKeys(document2,{limits:[tables[0]??{},tables[0]??{}]}):withKeys(document2,{limits:tables[0]&&filled(tables[0])})}var limitRegions=document2=>limitsOf(
document2).flatMap((table3,index)=>["fixed_pivot","moving_pivot"].filter(key=>table3[key]).map(key=>{let[[shape,points]]=Object.entries(table3[key]);return{table:index,
key,shape,points:shape==="point"?[points]:points}})),shapeOf=(shape,points)=>({[shape]:shape==="point"?points[0]:points}),setRequirement=(document2,key,value)=>withKeys(
document2,{requirements:filled(withKeys(document2.requirements??{},{[key]:value}))});function component(poses,index,key){if(Number.isFinite(poses[index][key]))return poses[index][key];
let before=poses.slice(0,index).findLastIndex(pose=>Number.isFinite(pose[key])),behind=poses.slice(index+1).findIndex(pose=>Number.isFinite(pose[key]))+index+1,
[a,b]=[poses[before]?.[key],behind>index?poses[behind][key]:void 0];return a===void 0||b===void 0?a??b??0:a+(index-before)/(behind-before)*(b-a)}function standing({
poses},index){let{x,y,angle}=poses[index];return Number.isFinite(x)&&Number.isFinite(y)&&Number.isFinite(angle)?{x,y,angle}:{x:component(poses,index,"x"),y:component(
poses,index,"y"),angle:component(poses,index,"angle")}}var poseName2=({poses},index)=>(poses[index]?.name??String(index+1)).replace(/[\r\n\u2028\u2029]+/g," "),
statedOf=(pose,changes)=>Object.fromEntries(Object.entries(changes).filter(([key])=>Number.isFinite(pose[key])));var Pace=class{timer;constructor(work,wanted=()=>!0){this.work=work,this.wanted=wanted,this.free=0,this.timer=null,paces.add(this)}ask(){this.timer!==null||!this.
wanted()||(this.timer=setTimeout(()=>this.now(),Math.max(0,this.free-performance.now())))}catchUp(){this.timer!==null&&this.now()}now(){clearTimeout(this.timer),
this.timer=null;let start=performance.now();this.work();let end=performance.now();this.free=end+Math.max(250,8*(end-start))}},shown=new WeakMap;function isOther(element,facts){
let before=shown.get(element);return shown.set(element,facts),before?.length!==facts.length||facts.some((fact,k)=>!Object.is(fact,before[k]))}var sights=new WeakMap,
callers=new WeakMap,observer=null;function watch(element,fn){observer??=new IntersectionObserver(entries=>{for(let{target,isIntersecting}of entries)sights.set(target,
isIntersecting),isIntersecting&&callers.get(target)?.()}),callers.set(element,fn),observer.observe(element)}var isSeen=element=>printing||sights.get(element)===
!0,paces=new Set,printing=!1;function catchUpForPrint(){addEventListener("beforeprint",()=>{printing=!0;for(let pace of paces)pace.wanted()&&pace.now()}),addEventListener(
"afterprint",()=>printing=!1)}var OFF=[16,20],HandleField=class{what=null;constructor(store,scene){this.store=store,this.scene=scene,this.element=h("div",{class:"bs-handle-field",role:"group",
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
away2=distance+9*ring;places.push([(away2+half-5)*Math.cos(angle),away2*Math.sin(angle),3*Math.abs(turn)+14*ring])}return places}function along(up,width){let reach=Math.
max(0,width/2-30);return[0,-.5,.5,-1,1].flatMap(share=>[[share*reach,up,8*Math.abs(share)],[share*reach,-up,10+8*Math.abs(share)]])}var NamePlaces=class{timer;constructor(scene){
this.scene=scene,this.names=new Map,this.obstacles=[],this.timer=null,scene.on("dropped",()=>this.ask())}avoid(fn){this.obstacles.push(fn)}get areMany(){return this.
names.size>MANY}put(element,x,y,text,places){let before=this.names.get(element),name={x,y,text,places,at:before?.text===text?before.at:places[0]};this.names.set(
element,name),this.show(element,name),this.ask()}ask(){clearTimeout(this.timer),this.scene.dragged||(this.timer=setTimeout(()=>this.place(),REST))}show(element,{
x,y,at}){put(element,"text-anchor","middle"),put(element,"transform",`translate(${px(x+at[0])} ${px(y-at[1]+4)})`)}place(){if(this.scene.dragged)return;for(let element of[
...this.names.keys()])element.isConnected||this.names.delete(element);let{width,height}=this.scene.view,seen2=[...this.names].filter(([element,{x,y}])=>x>-20&&y>
-20&&x<width+20&&y<height+20&&element.getAttribute("display")!=="none"),taken=this.obstacles.flatMap(fn=>fn()).map(boxOf2),stands=new Map;for(let pass=0;pass<(this.
areMany?1:2);pass+=1)for(let[element,name]of seen2){stands.delete(element);let others=[...stands.values()],best={cost:1/0,at:name.at,box:[0,0,0,0]};for(let at of name.
places){let box=boxAt(name,at),habit=at[0]===name.at[0]&&at[1]===name.at[1]?HABIT:0,cost=at[2]-habit;(box[0]<2||box[1]<2||box[2]>width-2||box[3]>height-2)&&(cost+=
OUTSIDE);for(let other of taken)cost+=overlap(box,other);for(let other of others)cost+=SAME*overlap(box,other);let own=awayFrom(box,name);seen2.some(([,other])=>other!==
name&&awayFrom(box,other)<own+1)&&(cost+=MISLEADING),cost<best.cost&&(best={cost,at,box})}name.at=best.at,stands.set(element,best.box)}for(let[element,name]of seen2)
this.show(element,name)}},boxOf2=([x,y,width,height])=>[x-width/2,y-height/2,x+width/2,y+height/2],boxAt=({x,y,text},at)=>boxOf2([x+at[0],y-at[1],LETTER*text.length+
4,HEIGHT]),awayFrom=(box,{x,y})=>Math.hypot(Math.max(box[0]-x,0,x-box[2]),Math.max(box[1]-y,0,y-box[3]));function overlap(one,other){let across=Math.min(one[2],
other[2])-Math.max(one[0],other[0]),down=Math.min(one[3],other[3])-Math.max(one[1],other[1]);return across>0&&down>0?across*down:0}var cross=([a,b],[c,d])=>a*d-b*c,minus=([a,b],[c,d])=>[a-c,b-d],size=([a,b])=>Math.hypot(a,b);function fromSegment(point2,start,end){let along2=minus(end,start),
away2=minus(point2,start),square=along2[0]**2+along2[1]**2,share=square>0?Math.min(1,Math.max(0,(along2[0]*away2[0]+along2[1]*away2[1])/square)):0;return size(minus(
away2,[share*along2[0],share*along2[1]]))}var boxCorners=([[a,b],[c,d]])=>[[a,b],[c,b],[c,d],[a,d]],outlineOf=(shape,points)=>shape==="box"?boxCorners(points):points;
function isInside([x,y],corners){let inside2=!1;return corners.forEach(([a,b],k)=>{let[c,d]=corners[(k+1)%corners.length];b>y!=d>y&&x<a+(y-b)/(d-b)*(c-a)&&(inside2=
!inside2)}),inside2}function distanceTo(point2,shape,points){if(shape==="point")return size(minus(point2,points[0]));if(shape==="segment")return fromSegment(point2,
...points);if(shape==="line"){let along2=minus(points[1],points[0]);return Math.abs(cross(along2,minus(point2,points[0])))/size(along2)}let corners=outlineOf(shape,
points);return isInside(point2,corners)?0:Math.min(...corners.map((corner,k)=>fromSegment(point2,corner,corners[(k+1)%corners.length])))}var crosses=(a,b,c,d)=>{
let turn=(p,q,r)=>Math.sign(cross(minus(q,p),minus(r,p)));return turn(a,b,c)*turn(a,b,d)<0&&turn(c,d,a)*turn(c,d,b)<0},edges=corners=>corners.map((corner,k)=>[corner,
corners[(k+1)%corners.length]]);function overlap2(one,other){return isInside(one[0],other)||isInside(other[0],one)?!0:edges(one).some(([a,b])=>edges(other).some(
([c,d])=>crosses(a,b,c,d)))}function segmentFromPolygon([start,end],corners){return isInside(start,corners)||edges(corners).some(([c,d])=>crosses(start,end,c,d))?
0:Math.min(...edges(corners).map(([c,d])=>Math.min(fromSegment(start,c,d),fromSegment(end,c,d),fromSegment(c,start,end),fromSegment(d,start,end))))}var ROUNDING=1e-6,MOST_PLACES2=90,KEYS=["fixed_pivot","moving_pivot"];function currentLinkage(store){if(store.chosen==="placed")return store.placed?.linkage??null;
let followed=store.followed?.linkages.find(({id})=>id===store.chosen);return followed?.led?followed:store.followed?.vanished?.some(({id})=>id===store.chosen)?null:
store.solved?.linkages.find(({id})=>id===store.chosen)??null}var PIVOT={fixed_pivot:"fixed pivot",moving_pivot:"moving pivot"};function missed(table3,dyad,slack){
let found=[];for(let key of KEYS){if(!table3[key])continue;let[[shape,stated]]=Object.entries(table3[key]),points=shape==="point"?[stated]:stated,away2=dyad[key]?
distanceTo(dyad[key],shape,points):1/0;away2>slack&&found.push({key,dyad:dyad.id,away:away2})}let{least:least2=0,most=1/0}=table3.length??{};return table3.length&&
dyad.kind==="RR"&&(dyad.radius<least2-slack||dyad.radius>most+slack)&&found.push({key:"length",dyad:dyad.id,away:Math.max(least2-dyad.radius,dyad.radius-most)}),
table3.kinds&&!table3.kinds.includes(dyad.kind)&&found.push({key:"kinds",dyad:dyad.id,away:1/0}),found}function limitsMissed(document2,linkage,size2){let tables=limitsOf(
document2),slack=ROUNDING*size2,[one,other]=linkage.led;return tables.length<2?tables.map(table3=>[...missed(table3,one,slack),...missed(table3,other,slack)]):limitedDyads(
document2,linkage,size2).map((dyad,k)=>missed(tables[k],dyad,slack))}function limitedDyads(document2,{led:[one,other]},size2){let tables=limitsOf(document2),slack=ROUNDING*
size2,[straight,crossed]=[[one,other],[other,one]].map(dyads=>tables.length>1&&dyads.flatMap((dyad,k)=>missed(tables[k],dyad,slack)).length);return crossed<straight?
[other,one]:[one,other]}function missedSentence({key,dyad,away:away2},unit2){let by=`${Number(away2.toPrecision(2))}${unit2?` ${unit2}`:""}`;return key==="kinds"?
`${dyad} is of another kind.`:key==="length"?`The link of ${dyad} is ${by} beyond its range.`:away2===1/0?`${dyad} has no ${PIVOT[key]}.`:`The ${PIVOT[key]} of ${dyad}\
 is ${by} outside.`}function usedPlaces(linkage){let rows=(linkage.pose_errors??[]).filter(row=>row.way!==null&&row.frame!==null);if(!rows.length||!linkage.ways?.
length)return[];let counts=new Map;for(let{way:way2}of rows)counts.set(way2,(counts.get(way2)??0)+1);let[best]=[...counts].sort((a,b)=>b[1]-a[1])[0],way=linkage.
ways[best],frames=rows.filter(row=>row.way===best).map(({frame})=>frame),low=Math.floor(Math.min(...frames)),high=Math.ceil(Math.max(...frames)),stride=Math.max(
1,Math.ceil((high-low)/MOST_PLACES2)),places=[];for(let k=low;k<=high&&k<way.x.length;k+=stride)places.push({x:way.x[k],y:way.y[k],a:way.angle[k]});return places}
var regionCorners=region=>region.polygon??(region.box?boxCorners(region.box):null),seen=(body,place)=>body.map(corner=>act(place,corner));function posePlace(document2,k){
let{x,y,angle}=standing(document2,k);return{x,y,a:radians(angle)}}function regionsTouched(document2,linkage,body){let places=usedPlaces(linkage),width=document2.
surroundings?.link_width??0,margin=document2.surroundings?.margin??0,apart=Math.ceil(document2.poses.length/MOST_PLACES2),some2=[...document2.poses.keys()].filter(
k=>k%apart===0);return regionsOf(document2).map(region=>{let corners=regionCorners(region);if(!corners)return"";let pose=body.length>2?some2.find(k=>overlap2(seen(
body,posePlace(document2,k)),corners)):void 0;if(pose!==void 0)return`The body touches it at pose ${poseName2(document2,pose)}.`;if(!places.length)return"";if(body.
length>2&&places.some(place=>overlap2(seen(body,place),corners)))return"The body touches it.";for(let dyad of linkage.led){if(dyad.kind!=="RR")continue;let near2=Math.
min(...places.map(place=>segmentFromPolygon([dyad.fixed_pivot,act(place,dyad.moving_pivot)],corners)));if(near2===0||near2<width/2)return`The link of ${dyad.id}\
 touches it.`;if(near2<width/2+margin)return`The link of ${dyad.id} comes nearer than the margin.`}return""})}var POINT=9,LINE=6,GRID=4,FINER=5,STEP2=15,NEAR=2.2,PARALLEL=1,MOST=40,tenths=angle=>Number(angle.toFixed(1))+0,Snapping=class{isOn=!0;constructor(store,scene){
this.store=store,this.scene=scene,this.text=s("text",{class:"bs-snap-name"}),this.mark=s("path",{class:"bs-snap-mark"}),this.element=s("g",{class:"bs-snap","ari\
a-hidden":"true"},this.mark,this.text);for(let name of["dropped","tool"])scene.on(name,()=>this.clear())}clear(){this.element.remove()}show(point2,name){let[x,y]=point2,
{view}=this.scene,X=view.X(x),Y=view.Y(y);put(this.mark,"d",`M${px(X)} ${px(Y)}m-7 0h14m-7 -7v14`),put(this.text,"x",px(X+10)),put(this.text,"y",px(Y-10)),say(this.
text,name),this.scene.layer("tool").append(this.element)}place(k){let{x,y,angle}=standing(this.store.document,k);return{x,y,a:radians(angle)}}targets(){let{store}=this,
{document:document2}=store,poses=[...document2.poses.keys()].slice(0,MOST),points=[],lines=[],corners=(list,name,of,place={x:0,y:0,a:0})=>points.push(...list.map(
point2=>({at:act(place,point2),name:`corner of ${name}`,of,isStated:!place.x&&!place.y&&!place.a})));for(let dyad of currentLinkage(store)?.led??[])dyad.fixed_pivot&&
points.push({at:dyad.fixed_pivot,name:`fixed pivot of ${dyad.id}`,of:"linkage"}),dyad.moving_pivot&&poses.length&&points.push({at:act(this.place(store.referenceIndex),
dyad.moving_pivot),name:`moving pivot of ${dyad.id}`,of:"linkage"});regionsOf(document2).forEach((region,k)=>(region.box||region.polygon)&&corners(region.polygon??
outlineOf("box",region.box),region.name??`region ${k+1}`,`region ${k}`)),limitRegions(document2).forEach(({key,shape,points:list},k)=>key==="fixed_pivot"&&corners(
outlineOf(shape,list),"the limit",`limit ${k}`));for(let k of poses){let{x,y,a}=this.place(k),name=`pose ${poseName2(document2,k)}`,of=`pose ${k}`;if(points.push(
{at:[x,y],name,of,isStated:!0}),document2.poses[k].angle!==void 0)for(let turn of[0,90])lines.push({at:[x,y],along:[Math.cos(a+radians(turn)),Math.sin(a+radians(
turn))],name:`${turn?"y":"x"} axis of ${name}`,of});corners(bodyOf(document2),`the body at ${name}`,`body ${of}`,{x,y,a})}return{points,lines}}point([x,y],{event,
from=null,skip=()=>!1}={}){let{scene}=this,{scale}=scene.view,rounded=pair=>pair.map(value=>scene.rounded(value));if(this.clear(),event?.shiftKey&&from){let across=Math.
abs(x-from[0])>=Math.abs(y-from[1]),at2=across?[scene.rounded(x),from[1]]:[from[0],scene.rounded(y)];return this.show(at2,across?"horizontal":"vertical"),at2}if(!this.
isOn||event?.altKey)return rounded([x,y]);let{points,lines}=this.targets(),away2=({at:at2,along:along2})=>scale*(along2?Math.abs((x-at2[0])*along2[1]-(y-at2[1])*
along2[0]):Math.hypot(x-at2[0],y-at2[1])),nearest=(list,most)=>list.filter(({of})=>!skip(of)).map(each2=>({...each2,away:away2(each2)})).filter(each2=>each2.away<
most).sort((a,b)=>a.away-b.away)[0],onPoint=nearest(points,POINT),onLine=onPoint?null:nearest(lines,LINE);if(onPoint)return this.show(onPoint.at,onPoint.name),onPoint.
isStated?onPoint.at:rounded(onPoint.at);if(onLine){let{at:at2,along:along2}=onLine,share=(x-at2[0])*along2[0]+(y-at2[1])*along2[1],foot2=[at2[0]+share*along2[0],
at2[1]+share*along2[1]];return this.show(foot2,onLine.name),rounded(foot2)}let step=this.gridStep,found=[x,y].map(value=>{let line2=Number((Math.round(value/step)*
step).toPrecision(12));return scale*Math.abs(line2-value)<GRID?line2:null}),at=rounded([x,y]).map((value,k)=>found[k]??value);return found.some(value=>value!==null)&&
this.show(at,found.includes(null)?`grid, ${found[0]===null?"y":"x"} ${found[0]??found[1]}`:"grid"),at}get gridStep(){let{view}=this.scene,[one,other]=ticks(view.
x(0),view.x(view.width),view.width/110);return(other?other.at-one.at:10**Math.round(Math.log10(100/view.scale)))/FINER}angle(angle,at,{event,skip=-1}){this.clear();
let step=STEP2*Math.round(angle/STEP2);if(event?.altKey||!this.isOn&&!event?.shiftKey)return tenths(angle);if(event?.shiftKey||Math.abs(step-angle)<NEAR)return this.
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
points))}reveal(point2){let{view}=this,margin=Math.min(MARGIN,view.width/8);this.closeUp([point2,[view.x(margin),view.y(margin)],[view.x(view.width-margin),view.
y(view.height-margin)]])}grid(){let{view}=this,{width,height}=view,group=this.layer("grid"),name=this.unit=this.store.document.length_unit,unit2=name?` ${name}`:
"",across=ticks(view.x(0),view.x(width),width/110),up=ticks(view.y(height),view.y(0),height/80),lines=[...across.map(({at})=>`M${px(view.X(at))} 0V${height}`),...up.
map(({at})=>`M0 ${px(view.Y(at))}H${width}`)],origin=`M${px(clamp(view.X(0),-9,width+9))} 0V${height}M0 ${px(clamp(view.Y(0),-9,height+9))}H${width}`;group.replaceChildren(
s("path",{class:"bs-grid-line",d:lines.join("")}),s("path",{class:"bs-grid-axis",d:origin}),...across.filter(({at})=>view.X(at)>46&&view.X(at)<width-(unit2?54:30)).
map(({at,text})=>s("text",{x:px(view.X(at)),y:height-6,"text-anchor":"middle"},text)),...up.filter(({at})=>view.Y(at)>30&&view.Y(at)<height-24).map(({at,text})=>s(
"text",{x:6,y:px(view.Y(at)-4)},text)),s("text",{x:6,y:14},`y${unit2}`),s("text",{x:width-6,y:height-6,"text-anchor":"end"},`x${unit2}`))}get grain(){return 10**
Math.floor(Math.log10(.35/this.view.scale))}rounded(value){let{grain}=this,digits=clamp(-Math.round(Math.log10(grain)),0,12);return Number((Math.round(value/grain)*
grain).toFixed(digits))+0}get step(){let[x,y,u,v]=bounds(this.store.document.poses.map(pose=>[pose.x??0,pose.y??0])),span=Math.hypot(u-x,v-y);return Number.isFinite(
span)&&span>0?10**Math.floor(Math.log10(span/50)):1}at(event){this.box||(this.box=this.svg.getBoundingClientRect(),this.dragged||requestAnimationFrame(()=>this.
dragged||(this.box=null)));let{left,top}=this.box,X=event.clientX-left,Y=event.clientY-top;return{X,Y,x:this.view.x(X),y:this.view.y(Y)}}drag(element,{start=()=>!0,
move,end=()=>{},cancel=()=>{},click=()=>{}}){element.addEventListener("pointerdown",event=>{if(event.button!==0||this.tool||this.dragged)return;event.preventDefault(),
event.stopPropagation(),this.pressed=event,element.focus?.({preventScroll:!0}),this.pressed=null;let from=this.at(event),ended=new AbortController,{signal}=ended,
begun=!1,stop=finish=>{ended.abort(),this.dragged=this.box=null,this.svg.classList.remove("bs-grasped"),this.svg.hasPointerCapture?.(event.pointerId)&&this.svg.
releasePointerCapture(event.pointerId),finish(),this.emit("dropped")};this.dragged={cancel:()=>stop(()=>begun&&cancel())},this.capture(event);let on=(name,fn)=>this.
svg.addEventListener(name,each2=>each2.pointerId===event.pointerId&&fn(each2),{signal}),last=from,then=event.timeStamp,go=each2=>{let point2=this.at(each2);if(!(point2.
X===last.X&&point2.Y===last.Y)){if(last=point2,then=each2.timeStamp,!begun){if(Math.hypot(point2.X-from.X,point2.Y-from.Y)<CLICK)return;if(begun=start(from,event)!==
!1,!begun)return stop(()=>{});this.svg.classList.add("bs-grasped")}move(point2,each2)}};on("pointermove",go),on("pointerrawupdate",each2=>each2.timeStamp-then>=
RAW&&go(each2)),on("pointerup",each2=>stop(()=>begun?end(this.at(each2)):click(event))),on("pointercancel",()=>stop(()=>begun&&cancel()))})}use(tool){let before=this.
tool;this.tool=tool??null,before?.end?.(),this.svg.classList.toggle("bs-drawing",!!tool),this.emit("tool",this.tool),tool&&this.svg.focus({preventScroll:!0})}listen(){
let{svg}=this;svg.addEventListener("wheel",event=>{if(this.zoomKey&&!event.ctrlKey&&!event.metaKey)return;event.preventDefault();let{X,Y}=this.at(event),unit2=event.
deltaMode===1?16:1;this.zoom(ZOOM**(-event.deltaY*unit2*(event.ctrlKey&&!this.zoomKey?4:1)),X,Y)},{passive:!1}),svg.addEventListener("pointerdown",event=>this.press(
event)),svg.addEventListener("pointermove",event=>this.moved(event));for(let name of["pointerup","pointercancel"])svg.addEventListener(name,event=>this.released(
event));svg.addEventListener("keydown",event=>this.key(event))}capture({pointerId}){try{this.svg.setPointerCapture(pointerId)}catch{}}press(event){if(event.button!==
0&&event.button!==1)return;let{X,Y}=this.at(event);if(this.pointers.set(event.pointerId,{X,Y,from:{X,Y},button:event.button,isMarquee:event.shiftKey&&!this.tool}),
this.pointers.size>1)for(let each2 of this.pointers.values())each2.panned=!0;this.capture(event)}moved(event){let point2=this.at(event),held=this.pointers.get(event.
pointerId);if(!held){this.dragged||this.tool?.hover?.(point2,event);return}let before={X:held.X,Y:held.Y};if(Object.assign(held,{X:point2.X,Y:point2.Y}),this.pointers.
size===2){let[one,other]=this.pointers.values(),still=held===one?other:one,[now,then]=[point2,before].map(({X,Y})=>Math.hypot(X-still.X,Y-still.Y));then>0&&this.
zoom(now/then,(point2.X+still.X)/2,(point2.Y+still.Y)/2);return}if(held.panned||=Math.hypot(point2.X-held.from.X,point2.Y-held.from.Y)>CLICK,!!held.panned){if(held.
isMarquee)return void this.stretch(held);this.tool?.drag?.(point2,held,event)||(this.svg.classList.add("bs-grasped"),this.pan(point2.X-before.X,point2.Y-before.
Y))}}released(event){let held=this.pointers.get(event.pointerId);if(!held)return;this.pointers.delete(event.pointerId),this.svg.classList.remove("bs-grasped");let point2=this.
at(event);event.type==="pointercancel"?this.tool?.hover?.(null):held.panned&&held.isMarquee?this.caught(held):held.panned?this.tool?.release?.(point2,held):held.
button===0&&(this.tool?this.tool.click(point2,event):this.emit("click",point2,event))}stretch({X,Y,from}){for(let[key,value]of Object.entries({x:Math.min(X,from.
X),y:Math.min(Y,from.Y),width:Math.abs(X-from.X),height:Math.abs(Y-from.Y)}))put(this.marquee,key,value);this.layer("tool").append(this.marquee)}caught({X,Y,from}){
let{view}=this;this.marquee.remove(),this.emit("marquee",bounds([[view.x(X),view.y(Y)],[view.x(from.X),view.y(from.Y)]]))}key(event){if(event.target!==this.svg||
event.ctrlKey||event.metaKey||this.emit("key",event)||event.altKey)return;let by=event.shiftKey?160:40,{width,height}=this.size,steps={ArrowLeft:[by,0],ArrowRight:[
-by,0],ArrowUp:[0,by],ArrowDown:[0,-by]};if(steps[event.key])this.pan(...steps[event.key]);else if(event.key==="+"||event.key==="=")this.zoom(1.25,width/2,height/
2);else if(event.key==="-")this.zoom(.8,width/2,height/2);else if(event.key==="0")this.fitAgain();else if(event.key==="z")this.emit("closer");else return;event.
preventDefault()}},Kept=class{constructor(group,make,show){this.group=group,this.make=make,this.show=show,this.elements=new Map}draw(items){let kept2=new Map;for(let[
key,item]of items){let element=this.elements.get(key)??this.make(key,item);kept2.set(key,element),this.show(element,item)}for(let[key,element]of this.elements)kept2.
has(key)||element.remove();let before=null;for(let element of kept2.values()){let next=before?before.nextSibling:this.group.firstChild;(element!==next||element.
parentNode!==this.group)&&this.group.insertBefore(element,next),before=element}this.elements=kept2}};var ARROWS={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},LEAST_CORNERS=3,CLOSED=new Set(["box","polygon"]),GROUND={x:0,y:0,a:0};function pathOf(shape,points,place,view){
let seen2=outlineOf(shape,points).map(point2=>act(place,point2)).map(([x,y])=>[view.X(x),view.Y(y)]);if(shape==="point")return`M${px(seen2[0][0]-7)} ${px(seen2[0][1])}\
h14m-7 -7v14`;if(shape==="line"){let[[a,b],[c,d]]=seen2,size2=Math.hypot(c-a,d-b)||1,far=view.width+view.height+Math.hypot(a,b),[u,v]=[far*(c-a)/size2,far*(d-b)/
size2];return`M${px(a-u)} ${px(b-v)}L${px(c+u)} ${px(d+v)}`}return`M${seen2.map(point2=>point2.map(px).join(" ")).join("L")}${CLOSED.has(shape)?"Z":""}`}function withCorner(shape,points,k,to){
if(shape!=="box")return points.map((point2,i)=>i===k?to:point2);let opposite=boxCorners(points)[(k+2)%4];return[[Math.min(to[0],opposite[0]),Math.min(to[1],opposite[1])],
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
point([x,y],{event,from:from&&act(place,from),skip:each2=>each2.startsWith(of)});return this.inFrame(at)}inFrame(at){let{place}=this.now;return place.x||place.y||
place.a?back(place,at).map(each2=>this.scene.rounded(each2)):at}openField(k){let{now:{name,place}}=this,corner=()=>outlineOf(this.now.shape,this.now.points)[k];
this.scene.field.open({name:`corner ${k+1} of ${name}`,kind:this.scene.store.selection?.kind,fields:[["x","x","length"],["y","y","length"]],at:()=>corner()&&this.
element.isConnected&&act(place,corner()),values:()=>({x:corner()[0],y:corner()[1]}),set:({x=corner()[0],y=corner()[1]})=>this.set(withCorner(this.now.shape,this.
now.points,k,[x,y]),null)})}dragWhole(){let gesture,off,before,corner;this.scene.drag(this.area,{start:point2=>{let away2=each2=>Math.hypot(...act(this.now.place,
each2).map((value,k)=>value-[point2.x,point2.y][k]));gesture=Symbol("move a shape"),before=this.now.points,corner=before.reduce((one,other)=>away2(other)<away2(
one)?other:one);let[x,y]=act(this.now.place,corner);off=[x-point2.x,y-point2.y]},move:(point2,event)=>{let to=this.point({x:point2.x+off[0],y:point2.y+off[1]},event,
corner),by=[to[0]-corner[0],to[1]-corner[1]];this.set(before.map(([x,y])=>[stepped(x,by[0]),stepped(y,by[1])]),gesture)},cancel:()=>this.abandon(gesture),click:()=>this.
select()})}makeCorner(k){let circle=s("circle",{class:"bs-corner",r:6,tabindex:0,role:"button","data-corner":k+1}),gesture,from;return this.scene.drag(circle,{start:()=>{
gesture=Symbol("move a corner"),from=outlineOf(this.now.shape,this.now.points)[k],this.openField(k)},move:(point2,event)=>this.set(withCorner(this.now.shape,this.
now.points,k,this.point(point2,event,from)),gesture),cancel:()=>this.abandon(gesture),click:()=>this.openField(k)}),circle.addEventListener("keydown",event=>this.
keys(event,(points,by)=>{let[x,y]=outlineOf(this.now.shape,points)[k];return withCorner(this.now.shape,points,k,[stepped(x,by[0]),stepped(y,by[1])])},()=>this.removeCorner(
k))),circle}removeCorner(k){let{shape,points}=this.now;shape!=="polygon"||points.length<=LEAST_CORNERS||this.set(points.filter((_,i)=>i!==k),null)}makeMiddle(k){
let circle=s("circle",{class:"bs-middle",r:4.5,"data-edge":k+1}),gesture;return this.scene.drag(circle,{start:()=>{gesture=Symbol("add a corner"),this.set([...this.
now.points.slice(0,k+1),this.now.points[k],...this.now.points.slice(k+1)],gesture)},move:(point2,event)=>this.set(withCorner("polygon",this.now.points,k+1,this.
point(point2,event)),gesture),cancel:()=>this.abandon(gesture)}),circle}showCorner(element,k){let corner=outlineOf(this.now.shape,this.now.points)[k];for(let[name,
value]of Object.entries(this.at(corner)))put(element,name,value);put(element,"aria-label",`Corner ${k+1} of ${this.now.name}: ${corner.join(", ")}`)}showMiddle(element,k){
let{points}=this.now,next=points[(k+1)%points.length],middle2=this.at([(points[k][0]+next[0])/2,(points[k][1]+next[1])/2]);for(let[name,value]of Object.entries(
middle2))put(element,name,value)}keys(event,moved2,remove){if(event.ctrlKey||event.metaKey)return;let arrow2=ARROWS[event.key];if(arrow2){event.repeat||(this.keyed=
Symbol("keys"));let by=stepOf(event,this.scene.step);this.set(moved2(this.now.points,[by*arrow2[0],by*arrow2[1]]),this.keyed)}else if(event.key==="Delete"||event.
key==="Backspace")remove();else return;event.preventDefault(),event.stopPropagation()}};var CLOSE=12,PAIRS=new Set(["segment","line","box"]),HINTS={point:"Click the point. Enter puts it in the middle, Escape gives up.",segment:"Click both ends. Ent\
er puts one in the middle, Escape gives up.",line:"Click two points of the line. Enter puts one in the middle, Escape gives up.",box:"Drag from corner to corner\
, or click both. Enter puts one in the middle, Escape gives up.",polygon:"Click the corners; Enter or a click on the first one closes. Backspace takes the last \
one back, Escape gives up."},MIDDLE={point:[[0,0]],segment:[[-1,0],[1,0]],line:[[-1,0],[1,0]],box:[[-1,-1],[1,1]],polygon:[[-1,-1],[1,-1],[0,1]]},SHARE=.12,ordered=([
[a,b],[c,d]])=>[[Math.min(a,c),Math.min(b,d)],[Math.max(a,c),Math.max(b,d)]],isFlat=([[a,b],[c,d]])=>a===c&&b===d,ShapeTool=class{constructor(scene,{shape,place,
done,name,at=""}){this.scene=scene,this.shape=shape,this.place=place,this.done=done,this.name=name,this.points=[],this.next=null,this.hint=at?`${at}. ${HINTS[shape]}`:
HINTS[shape],this.isOfBody=!!at,this.path=s("path",{class:"bs-draft"}),this.dots=s("g"),this.element=s("g",{},this.path,this.dots),scene.layer("tool").append(this.
element)}point({x,y},event){let place=this.place(),last=this.points.at(-1),at=this.scene.snap.point([x,y],{event,from:last&&act(place,last)});return place.x||place.
y||place.a?back(place,at).map(each2=>this.scene.rounded(each2)):at}click(point2,event){let next=this.point(point2,event);if(this.shape==="polygon"){if(this.points.
length>2&&(this.isFirst(point2)||event?.detail>1))return this.finish(this.points);if(this.points.length&&isFlat([this.points.at(-1),next]))return}return this.points.
push(next),this.shape==="point"||PAIRS.has(this.shape)&&this.points.length===2?this.finish(this.points):this.draw()}isFirst({X,Y}){let[x,y]=act(this.place(),this.
points[0]),{view}=this.scene;return Math.hypot(view.X(x)-X,view.Y(y)-Y)<CLOSE}hover(point2,event){this.next=point2&&this.point(point2,event),this.draw()}drag(point2,held,event){
return!PAIRS.has(this.shape)||this.points.length?!1:(this.dragging=[this.point(this.inPlane(held.from),event),this.point(point2,event)],this.draw(),!0)}inPlane({
X,Y}){return{x:this.scene.view.x(X),y:this.scene.view.y(Y)}}inMiddle(){let{width,height}=this.scene.size,half=SHARE*Math.min(width,height);return MIDDLE[this.shape].
map(([x,y])=>this.point(this.inPlane({X:width/2+half*x,Y:height/2-half*y})))}release(){if(!this.dragging)return;let pair=this.dragging;this.dragging=null,this.finish(
pair)}finish(points){return PAIRS.has(this.shape)&&isFlat(points)?(this.points=points.slice(0,1),this.draw()):(this.scene.use(null),this.done(this.shape==="box"?
ordered(points):points))}key(event){if(event.key==="Escape")this.scene.use(null);else if(event.key==="Backspace")this.points.pop();else if(event.key==="Enter"&&
!this.points.length)this.finish(this.inMiddle());else if(event.key==="Enter"&&this.points.length>2)this.finish(this.points);else return!1;return this.draw(),!0}draw(){
let{scene:{view},shape}=this,shown2=this.dragging??[...this.points,...this.next?[this.next]:[]],place=this.place(),whole=shape==="polygon"?"open polygon":shape,
complete=shown2.length>1||shape==="point";put(this.path,"d",complete&&shown2.length?pathOf(whole,shown2,place,view):""),this.dots.replaceChildren(...(this.dragging??
this.points).map(point2=>act(place,point2)).map(([x,y],k)=>s("circle",{class:k?"bs-draft-dot":"bs-draft-dot bs-first",r:4,cx:px(view.X(x)),cy:px(view.Y(y))})))}end(){
this.element.remove()}};var PALEST2=.4;function referencePlace(store){let k=store.referenceIndex;if(k<0)return{x:0,y:0,a:0};let{x,y,angle}=standing(store.document,k);return{x,y,a:radians(
angle)}}var atReference=store=>`Drawn at pose ${poseName2(store.document,Math.max(0,store.referenceIndex))}`,BodyEditor=class{constructor(store,scene){this.store=
store,this.scene=scene,this.ghosts=new Kept(s("g",{class:"bs-ghosts","aria-hidden":"true"}),()=>s("path",{class:"bs-ghost"}),(path2,item)=>this.showGhost(path2,
item)),scene.layer("ghosts").append(this.ghosts.group),this.handles=new ShapeHandles(scene,{className:"bs-body-shape",what:()=>({shape:"polygon",points:bodyOf(store.
document),place:referencePlace(store),name:"Outline of the body",selected:store.selection?.kind==="body",data:{body:""}}),set:(points,gesture)=>store.edit(document2=>setBody(
document2,points),{gesture}),remove:()=>store.edit(document2=>setBody(document2,[])),select:()=>store.select({kind:"body",index:0}),abandon:gesture=>store.abandon(
gesture)}),store.on("document selection reference",()=>this.draw()),scene.on("view",()=>this.draw()),store.on("document selection",()=>this.watch()),scene.on("t\
ool",()=>this.watch()),this.draw()}watch(){let{store,scene}=this,{selection,document:document2}=store,isOfBody=selection?.kind==="body"||selection?.kind==="limi\
t"&&limitRegions(document2)[selection.index]?.key==="moving_pivot",isOn=!!(scene.tool?.isOfBody||isOfBody);isOn!==store.isOnBody&&(store.isOnBody=isOn,scene.svg.
classList.toggle("bs-on-body",isOn),store.emit("reference"))}indices(){let{document:{poses},selectedPoses,referenceIndex}=this.store;return poses.map((_,k)=>k).
filter(k=>hasGhost(k,poses.length)||selectedPoses.includes(k)||k===referenceIndex&&this.store.isOnBody)}draw(){let body=bodyOf(this.store.document),{scale}=this.
scene.view;return this.path=body.length?`M${body.map(([x,y])=>`${px(scale*x)} ${px(-scale*y)}`).join("L")}Z`:"",this.ghosts.draw(body.length?this.indices().map(
k=>[k,k]):[]),!body.length||!this.store.document.poses.length?this.handles.clear():(this.handles.element.parentNode||this.scene.layer("ghosts").append(this.handles.
element),this.handles.draw())}showGhost(path2,k){let{view}=this.scene,{x,y,angle}=standing(this.store.document,k),last=Math.max(1,this.store.document.poses.length-
1);path2.classList.toggle("bs-reference",k===this.store.referenceIndex),isOther(path2,[view,x,y,angle,k/last,this.path])&&(put(path2,"d",this.path),put(path2,"o\
pacity",(PALEST2+(1-PALEST2)*k/last).toFixed(3)),put(path2,"transform",transform(view.X(x),view.Y(y),radians(angle))))}tool(){return new ShapeTool(this.scene,{shape:"\
polygon",name:"body",place:()=>referencePlace(this.store),at:atReference(this.store),done:points=>{this.store.edit(document2=>setBody(document2,points)),this.store.
select({kind:"body",index:0})}})}};var AGAIN=[250,500,1e3,2e3,4e3],KEY3="burmester.studio.key",UNFINISHED=new Set(["solving","progress","waiting"]),Refused=class extends Error{constructor(status,messages){
super(messages.map(each2=>each2.message).join(" ")||`the server answered ${status}`),this.status=status,this.messages=messages}};async function messagesOf(response){
try{return(await response.json()).messages??[]}catch{return[]}}var Connection=class{socket;constructor(decode){this.decode=decode,this.listeners={message:[],open:[],
closed:[]},this.asked=new Map,this.n=0,this.tries=0,this.socket=null}on(name,fn){this.listeners[name].push(fn)}emit(name,value){for(let fn of this.listeners[name])
fn(value)}get isOpen(){return this.socket?.readyState===1}get key(){try{return localStorage.getItem(KEY3)??this.own}catch{return this.own}}async session(){let token=decodeURIComponent(
location.hash.slice(1)).replace(/^token=/,"");if(token){history.replaceState(null,"",location.pathname);try{this.own=(await(await this.post("/session",{token})).
json()).key}catch(error){if(!(error instanceof Refused)||!this.key)throw error;return}try{localStorage.setItem(KEY3,this.own)}catch{}}}async get(path2){return(await this.
request(path2,{})).json()}post(path2,body,method="POST"){return this.request(path2,{method,headers:{"Content-Type":"application/json"},body:JSON.stringify(body)})}async request(path2,options){
let headers={...options.headers,Authorization:`Bearer ${this.key}`},response=await fetch(path2,{credentials:"omit",...options,headers});if(!response.ok)throw new Refused(
response.status,await messagesOf(response));return response}open(){clearTimeout(this.timer),this.socket?.close();let socket=new WebSocket(`${location.protocol===
"https:"?"wss":"ws"}://${location.host}/live`,["burmester",this.key]);socket.binaryType="arraybuffer",this.socket=socket,socket.onopen=()=>{this.tries=0,this.emit(
"open")},socket.onmessage=({data})=>{socket===this.socket&&this.take(typeof data=="string"?JSON.parse(data):this.decode(data))},socket.onclose=()=>{if(socket===
this.socket){for(let{reject}of this.asked.values())reject(new Error("the connection ended"));this.asked.clear(),this.emit("closed",this.tries),this.timer=setTimeout(
()=>this.open(),AGAIN[Math.min(this.tries,AGAIN.length-1)]),this.tries+=1}}}take(message){let waiting=this.asked.get(message.n);waiting&&!UNFINISHED.has(message.
kind)&&(this.asked.delete(message.n),waiting.resolve(message)),this.emit("message",message)}send(message){return this.isOpen?(this.n+=1,this.socket.send(JSON.stringify(
{n:this.n,...message})),this.n):null}ask(message){return new Promise((resolve,reject)=>{let n=this.send(message);n===null?reject(new Error("the connection is cl\
osed")):this.asked.set(n,{resolve,reject})})}};var DRAWINGS=/\.(svg|dxf)$/i,TASKS=/\.(toml|json)$/i,KINDS=".toml,.json,.csv,.tsv,.txt,.xlsx,.parquet,.trc,.svg,.dxf",BESIDE=["limits","requirements","keep_out",
"surroundings","body"],HEADERS={2:["x,y","Read them as x, y: points"],3:["x,y,angle_deg","Read them as x, y, angle in degrees"]},LARGEST=14e5;async function base64Of(file){
let bytes=new Uint8Array(await file.arrayBuffer()),text="";for(let k=0;k<bytes.length;k+=32768)text+=String.fromCharCode(...bytes.subarray(k,k+32768));return btoa(
text)}var isTable=text=>/\d/.test(text)&&(/\t/.test(text)||/\n\s*\S/.test(text.trim()));function download(blob,name){let address=URL.createObjectURL(blob);h("a",
{href:address,download:name}).click(),setTimeout(()=>URL.revokeObjectURL(address),1e4)}function popover(text,list,fill,attributes={}){let summary=h("summary",{class:"\
bm-button"},text),element=h("details",{class:"bs-menu",...attributes},summary,list),close=()=>{element.open&&(element.open=!1,summary.focus())};return element.addEventListener(
"toggle",()=>element.open&&fill(close)),element.addEventListener("keydown",event=>{let all=[...list.querySelectorAll(".bs-menu-item")],at=all.indexOf(document.activeElement),
step={ArrowDown:1,ArrowUp:-1}[event.key];if(event.key==="Escape")close();else if(step&&(at>=0||document.activeElement===summary))all[(at+step+all.length)%all.length]?.
focus();else return;event.preventDefault(),event.stopPropagation()}),document.addEventListener("pointerdown",event=>element.contains(event.target)||(element.open=
!1)),element}var menuItem=({title,note,act:act2,data},close,attributes={})=>h("button",{type:"button",class:"bs-menu-item",...attributes,...data,onclick:()=>(close(),
act2())},h("b",{},title),note?h("span",{},note):null);function menu(text,items,attributes={}){let list=h("div",{class:"bs-menu-list",role:"menu"});return popover(
text,list,close=>list.replaceChildren(...items().map(each2=>each2.heading?h("p",{class:"bs-menu-heading",role:"presentation"},each2.heading):menuItem(each2,close,
{role:"menuitem"}))),attributes)}var Files=class{opened;constructor(store,start,banners){this.store=store,this.start=start,this.banners=banners,this.server=store.
connection,this.chooser=h("input",{type:"file",hidden:!0,accept:KINDS,"data-file":"open",onchange:()=>this.chosen(this.chooser)}),this.outlines=h("input",{type:"\
file",hidden:!0,accept:".svg,.dxf","data-file":"outline",onchange:()=>this.chosen(this.outlines)}),this.dropping=h("div",{class:"bs-dropping",hidden:!0,"aria-hi\
dden":"true"},h("p",{},"Drop a task, a table of poses, or the outline of the body")),this.dialog=h("dialog",{class:"bs-dialog","aria-label":"The same from the c\
ommand line"}),this.element=h("div",{class:"bs-files"},this.menu(),this.chooser,this.outlines,this.dropping,this.dialog),this.listen()}menu(){let item=(title,note,act2,data)=>({
title,note,act:act2,data:{"data-do":data}});return menu("Task",()=>[item("New","an empty task",()=>this.fresh(),"new"),item("Open…","a task, or a table of pos\
es (Ctrl+O)",()=>this.chooser.click(),"open"),item("Save task","the file that the command reads (Ctrl+S)",()=>this.save(),"save"),item("Copy as command","the sa\
me from the command line",()=>this.commands(),"command"),{heading:"Templates"},...(this.start.templates??[]).map(({name,summary})=>({title:name,note:summary,act:()=>this.
template(name),data:{"data-template":name}}))],{"data-menu":"task"})}get task(){let{document:document2,options,name}=this.store;return{document:document2,options,
name}}async trying(what,then,actions=[]){try{return await then()}catch(error){return error instanceof Refused&&error.messages.length?this.banners.say("refused",
`${what} was not done.`,error.messages,{actions}):this.banners.say("refused",`${what} was not done: ${error instanceof Refused?error.message:"the server does no\
t answer"}.`),null}}fresh(){this.store.replace({document:{length_unit:"mm",angle_unit:"deg",poses:[]},options:{},name:"task"})}template(name){return this.trying(
`Opening ${name}`,async()=>{let made2=await this.server.get(`/template/${encodeURIComponent(name)}`);this.store.replace({name,...made2}),this.opened?.()})}async chosen(input){
for(let file of input.files)await this.take(file,input===this.outlines);input.value=""}chooseOutline(){this.outlines.click()}take(file,asOutline=DRAWINGS.test(file.
name)&&this.store.document.poses.length>0&&!isPath(this.store.document)){let isDrawing=DRAWINGS.test(file.name),{document:before}=this.store,other=isDrawing?button(
asOutline?"Take it as a path to trace":"Take it as the outline of the body",()=>{for(let kind of["note","refused"])this.banners.close(kind);this.store.document!==
before&&this.store.undo(),this.take(file,!asOutline)},{"data-do":asOutline?"as-path":"as-outline"}):null;return this.trying(`Reading ${file.name}`,async()=>{if(file.
size>LARGEST)throw new Refused(413,[{message:`${file.name} has ${Math.round(file.size/1e3)} kB, and the page takes ${LARGEST/1e3}.`,help:"give it to the command\
: burmester studio FILE"}]);let body={name:file.name,base64:await base64Of(file),length_unit:this.store.document.length_unit};if(asOutline)return this.outline(await(await this.
server.post("/outline",body)).json(),file.name,other);let{document:document2,options={},notes=[]}=await(await this.server.post("/read",body)).json(),name=file.name.
replace(/\.[^.]*$/,""),whole=TASKS.test(file.name);return this.store.replace(whole?{document:document2,options,name}:{document:document2,options:this.store.options,
name}),this.opened?.(),this.banners.say("note",`${file.name} is open.`,notes,{undo:!0,actions:other?[other]:[]})},other?[other]:[])}outline({outline:corners,notes=[]},name,other){
this.store.edit(document2=>setBody(document2,corners)),this.store.select({kind:"body",index:0}),this.banners.say("note",`The outline of the body is that in ${name}\
: ${corners.length} corners.`,notes,{undo:!0,actions:other?[other]:[]})}paste(text,columns){let[first]=text.trim().split(`
`),header=HEADERS[first.trim().split(/\t/.test(first)?/\t/:/[,;\s]+/).length],again=!columns&&header&&!/[^\d\s.,;+\-eE\u2212]/.test(first)?[button(header[1],()=>(this.
banners.close("refused"),this.paste(text,header[0])),{"data-do":"read-columns"})]:[];return this.trying("Pasting",async()=>{let old=this.store.document,{document:document2,
notes=[]}=await(await this.server.post("/read",{name:"pasted",text,columns,length_unit:old.length_unit,angle_unit:"deg"})).json(),beside=Object.fromEntries(BESIDE.
filter(key=>old[key]!==void 0&&document2[key]===void 0).map(key=>[key,old[key]]));this.store.replace({document:withKeys(document2,{length_unit:document2.length_unit??
old.length_unit}),options:this.store.options,picture:this.store.picture}),this.store.select(null),this.opened?.(),this.banners.close("refused");let keep=button(
"Keep the limits and the body of the task before",()=>(keep.remove(),this.store.edit(now=>withKeys(now,beside))),{"data-do":"keep-rest"}),what=document2.poses.some(
pose=>pose.angle!==void 0)?"poses":"points";this.banners.say("note",`${document2.poses.length} ${what} were pasted.`,notes,{undo:!0,actions:Object.keys(beside).
length?[keep]:[]})},again)}save(){return this.trying("Saving",async()=>{try{await this.hand(await this.server.post("/task",this.task),`${this.store.name}.toml`)}catch(error){
if(error instanceof Refused)throw error;this.saveWithoutServer(),this.banners.say("note","The server does not answer: the task was saved as JSON, which the comm\
and reads as well.")}})}saveWithoutServer(){download(new Blob([`${JSON.stringify(this.store.document,null,2)}
`],{type:"application/json"}),`${this.store.name.replace(/[^\w.-]+/g,"-")||"task"}.json`)}get chosenLinkage(){let{chosen,placed}=this.store,dyads=chosen==="plac\
ed"?placed?.linkage?.dyads:void 0;return dyads?.every(dyad=>dyad.kind==="RR")?{linkage:null,dyads:dyads.map(({fixed_pivot,moving_pivot,radius})=>({fixed_pivot,moving_pivot,
radius}))}:{linkage:chosen==="placed"?null:chosen}}export(path2,what={}){return this.trying("Exporting",async()=>{this.hand(await this.server.post(path2,{...this.
task,...this.chosenLinkage,settings:this.store.settings,...what}),"export")})}async hand(response,otherwise){let name=/filename="([^"]+)"/.exec(response.headers.
get("Content-Disposition")??"")?.[1]??otherwise;download(await response.blob(),name)}commands(){return this.trying("Copying",async()=>{let{commands}=await(await this.
server.post("/command",{...this.task,settings:this.store.settings,...this.chosenLinkage})).json(),close=button("Close",()=>this.dialog.close(),{"data-do":"close"}),
said=h("p",{class:"bs-hint",role:"status"}),copy=async command=>{try{await navigator.clipboard.writeText(command),said.textContent="Copied."}catch{said.textContent=
"The browser does not let this page copy: select the text."}};this.dialog.replaceChildren(h("h2",{},"The same from the command line"),h("p",{class:"bs-hint"},"S\
ave the task first; the commands read that file."),...commands.map(({title,command})=>h("div",{class:"bs-command"},h("h3",{},title),h("pre",{tabindex:0},command),
button("Copy",()=>copy(command),{"aria-label":`Copy: ${title}`}))),h("div",{class:"bs-row"},close,said)),this.dialog.showModal()})}listen(){let inside2=0,hasFiles=event=>[
...event.dataTransfer?.types??[]].includes("Files"),show=by=>{inside2=Math.max(0,inside2+by),give(this.dropping,"hidden",inside2===0)};document.addEventListener(
"dragenter",event=>hasFiles(event)&&(event.preventDefault(),show(1))),document.addEventListener("dragover",event=>hasFiles(event)&&event.preventDefault()),document.
addEventListener("dragleave",event=>hasFiles(event)&&show(-1)),document.addEventListener("drop",async event=>{if(hasFiles(event)){event.preventDefault(),show(-1/0),
inside2=0;for(let file of event.dataTransfer?.files??[])await this.take(file)}}),document.addEventListener("paste",event=>{let text=event.clipboardData?.getData(
"text/plain")??"",[file]=event.clipboardData?.files??[],typing=event.target instanceof HTMLElement&&event.target.closest("input, textarea, select");if(file)this.
take(file);else if(isTable(text))this.paste(text);else return;event.preventDefault(),typing&&typing.blur()})}};var LENGTHS2=[["hole","holes"],["pin","pins"],["width","links are wide"],["thickness","plates are thick"],["gap","gap between plates"]],NUMBERS=[["pose","drawn \
at pose","1",{least:1,whole:!0}],["density","density, kg/m³","2700",{above:0}],["seconds","film, seconds","4",{above:0}],["frames_per_second","pictures a secon\
d","25",{above:0}],["width_px","pixels wide","800",{least:1,whole:!0}]],AXES=["y","x","z","-x","-y","-z"],UNITS=["mm","cm","m","in","ft"],USES={cut:"Cut",print:"\
Print",cad:"CAD",simulate:"Simulate",film:"Film",share:"Share"},ExportSettings=class{constructor(store,scene,formats,files){this.store=store;let set=name=>value=>store.
setting(name,value);this.fields=new Map;let number=(name,placeholder,options)=>{let field=new NumberField({label:name.replace(/_/g," "),commit:set(name),options:()=>({
optional:!0,unit:store.document.length_unit,...options}),step:()=>options.kind?scene.step:1,attributes:{"data-setting":name,placeholder}});return this.fields.set(
name,field),field.element};this.unit=choice("unit of what is exported",UNITS.map(unit2=>[unit2,unit2]),value=>set("unit")(value==="mm"?void 0:value),{"data-sett\
ing":"unit"}),this.unitRow=labelled("unit of the lengths",this.unit),this.up=choice("up",AXES.map(axis=>[axis,axis]),value=>set("up")(value==="y"?void 0:value),
{"data-setting":"up"}),this.dimensions=tick("drawings have dimension lines",on=>set("dimensions")(on?void 0:!1),{"data-setting":"dimensions"}),this.assembled=tick(
"STL: the parts in their places",on=>set("assembled")(on||void 0),{"data-setting":"assembled"});let rows=(all2,placeholderOf,optionsOf)=>all2.map(each2=>labelled(
each2[1],number(each2[0],placeholderOf(each2),optionsOf(each2))," ")),sizes=h("details",{class:"bs-section","data-section":"export"},h("summary",{},"Sizes and s\
ettings"),h("p",{class:"bs-hint"},"Left empty: sizes that suit the linkage."),h("div",{class:"bs-grid"},this.unitRow,rows(LENGTHS2,()=>"–",()=>({kind:"length",
above:0})),rows(NUMBERS,each2=>each2[2],each2=>each2[3]),labelled("up, in models",this.up)),this.dimensions.element,this.assembled.element),uses=h("div",{class:"\
bs-uses"}),all=[...formats.map(({format,title,suffix,use})=>({use,title,note:suffix,act:()=>files.export("/export",{format}),data:{"data-export":format}})),{use:"\
share",title:"Report",note:".html",act:()=>files.export("/report"),data:{"data-export":"report"}},{use:"share",title:"Result",note:".json",act:()=>files.export(
"/result"),data:{"data-export":"result"}}],fill=close=>uses.replaceChildren(...Object.entries(USES).map(([use,name])=>[name,all.filter(each2=>each2.use===use)]).
filter(([,some2])=>some2.length).map(([name,some2])=>h("div",{role:"group","aria-label":name},h("p",{class:"bs-menu-heading"},name),some2.map(each2=>menuItem(each2,
close)))));this.element=popover("Export",h("div",{class:"bs-menu-list bs-exports"},uses,sizes),fill,{"data-menu":"export"}),store.on("document",()=>this.draw()),
this.draw()}draw(){let{settings,document:document2}=this.store;for(let[name,field]of this.fields)field.show(settings[name]);give(this.unit,"value",settings.unit??
"mm"),give(this.unitRow,"hidden",!!document2.length_unit&&!settings.unit),give(this.up,"value",settings.up??"y"),give(this.dimensions.box,"checked",settings.dimensions!==
!1),give(this.assembled.box,"checked",!!settings.assembled)}};var WAY=["x","y","angle","drive","transmission"],POSE=["x","y","angle_deg","position","turned_deg","transmission_deg"];function decodeFrame(buffer){let length=new DataView(
buffer).getUint32(0,!0),header=JSON.parse(new TextDecoder().decode(new Uint8Array(buffer,4,length))),numbers=floats(buffer,4+length);for(let linkage of header.linkages??
[]){if(linkage.ways&&(linkage.ways=linkage.ways.map(way=>({...way,...pieces(numbers,way,WAY)}))),!linkage.poses)continue;let{count}=linkage.poses,columns=pieces(
numbers,linkage.poses,POSE);linkage.pose_errors=Array.from({length:count},(_,pose)=>{let at=linkage.at?.[pose]??null,row={way:at?at[0]:null,frame:at?at[1]:null};
for(let name of POSE){let value=columns[name][pose];row[name]=Number.isNaN(value)?null:value}return row})}return header}function floats(buffer,start){if(new Uint8Array(
new Uint16Array([1]).buffer)[0]===1)return new Float32Array(buffer,start);let view=new DataView(buffer,start);return Float32Array.from({length:view.byteLength/4},
(_,k)=>view.getFloat32(4*k,!0))}function pieces(numbers,{start,count},names){return Object.fromEntries(names.map((name,k)=>[name,numbers.subarray(start+k*count,
start+(k+1)*count)]))}var KEYS2=[["Tab","from handle to handle, field to field"],["arrow keys","move what has the focus by a step: a pose, the tip that turns it, a corner, a shape, a\
 number; Shift: ten steps, Alt: a tenth"],["Shift, Alt","while a hand drags: Shift holds an axis or steps of 15°, Alt frees it from what it snaps to"],["Shift \
and a click or a box","selects several poses, which are moved, turned and deleted together"],["a digit","after a drag: the number is typed beside the handle"],[
"Delete","removes the pose, the corner or the shape"],["Enter","closes an outline; puts a shape in the middle while it is drawn"],["Escape","gives up what is un\
der way: a drag, a drawing, a selection"],["+ − 0","on the plane: zoom and fit; arrow keys pan it"],["space","plays and stops"],["?","this list"],["Ctrl+Z, Ct\
rl+Shift+Z","undo and redo"],["Ctrl+S, Ctrl+O, Ctrl+V","save the task, open a file, paste rows of a spreadsheet"]];function keyList(){let close=button("Close",()=>dialog.
close()),dialog=h("dialog",{class:"bs-dialog","aria-label":"Keys"},h("h2",{},"Keys"),h("dl",{class:"bs-keys"},KEYS2.map(([key,what])=>h("div",{},h("dt",{},key),
h("dd",{},what)))),close);return document.addEventListener("keydown",event=>{event.key==="?"&&!written2(event.target)&&!dialog.open&&dialog.showModal()}),[button(
"?",()=>dialog.showModal(),{"data-do":"keys","aria-label":"Keys",title:"What keys do (?)"}),dialog]}var TYPED_IN="button, input, select, textarea, summary, a, [\
role=button], [role=slider]",written2=element=>element?.matches?.("input:not([type=checkbox]):not([type=radio]):not([type=range]), textarea");function listenToKeys(store,scene,files=null,root=document){
let acts=event=>({z:()=>event.shiftKey?store.redo():store.undo(),y:()=>store.redo(),...files&&{s:()=>files.save(),o:()=>files.chooser.click()}});root.addEventListener(
"keydown",event=>{let{key,target}=event;if((event.ctrlKey||event.metaKey)&&!event.altKey){let act2=acts(event)[key.toLowerCase()];if(!act2||written2(target)&&target.
dataset.typing==="true"&&/^[zy]$/i.test(key))return;event.preventDefault(),act2()}else scene.dragged&&key==="Escape"?(event.preventDefault(),scene.dragged.cancel()):
scene.tool&&!written2(target)&&scene.tool.key(event)?(event.preventDefault(),event.stopPropagation()):key==="Escape"&&!written2(target)&&store.selection&&store.
select(null)},!0),root.addEventListener("input",({target})=>target instanceof HTMLElement&&(target.dataset.typing="true"));for(let name of["change","focusout"])
root.addEventListener(name,({target})=>target instanceof HTMLElement&&delete target.dataset.typing)}function listenToSpace({player},root=document){root.addEventListener(
"keydown",event=>{event.key!==" "||event.ctrlKey||event.metaKey||event.altKey||event.target instanceof Element&&event.target.closest(TYPED_IN)||!player.path||(event.
preventDefault(),player.play(!player.playing))})}var POINTS=[12,40],APART=26,MEETS=16,SHARE2=.08,LEAST_LENGTH=40,SMOOTHED=9,OVAL=16;function lineOf({poses,path:path2},view){let points=poses.filter(({x,y})=>Number.
isFinite(x)&&Number.isFinite(y)).map(({x,y})=>`${px(view.X(x))} ${px(view.Y(y))}`);return points.length?`M${points.join("L")}${path2?.closed?"Z":""}`:""}var PathCurve=class{constructor(store,scene){
this.store=store,this.scene=scene,this.line=s("path",{class:"bs-path","aria-hidden":"true"}),scene.layer("regions").append(this.line),store.on("document",()=>this.
draw()),scene.on("view",()=>this.draw()),this.draw()}draw(){let{store:{document:document2},scene:{view}}=this;put(this.line,"d",isPath(document2)?lineOf(document2,
view):""),put(this.line,"data-path",isPath(document2)?document2.path?.closed?"closed":"open":null)}};function resampled(stroke,{meets,apart,smooth:smooth2=0}){let gap=Math.
hypot(stroke[0][0]-stroke.at(-1)[0],stroke[0][1]-stroke.at(-1)[1]),size2=Math.hypot(...[0,1].map(k=>Math.max(...stroke.map(each2=>each2[k]))-Math.min(...stroke.
map(each2=>each2[k])))),length=0;for(let k=1;k<stroke.length;k+=1)length+=Math.hypot(stroke[k][0]-stroke[k-1][0],stroke[k][1]-stroke[k-1][1]);let closed2=gap<Math.
max(meets,SHARE2*size2)&&length>3*gap+size2,line2=closed2?[...stroke,stroke[0]]:stroke,along2=[0];for(let k=1;k<line2.length;k+=1)along2.push(along2[k-1]+Math.hypot(
line2[k][0]-line2[k-1][0],line2[k][1]-line2[k-1][1]));let whole=along2[along2.length-1],count=clamp(Math.round(whole/apart),POINTS[0],POINTS[1]),at=wanted=>{let u=closed2?
(wanted%whole+whole)%whole:clamp(wanted,0,whole),k=1;for(;k<line2.length-1&&along2[k]<u;)k+=1;let t=along2[k]>along2[k-1]?(u-along2[k-1])/(along2[k]-along2[k-1]):
0;return[0,1].map(axis=>line2[k-1][axis]+t*(line2[k][axis]-line2[k-1][axis]))},near2=(u,k)=>{let half=closed2?smooth2:Math.min(smooth2,u,whole-u),parts=[-1,-.5,
0,.5,1].map(share=>at(u+share*half));return[0,1].map(axis=>parts.reduce((sum,each2)=>sum+each2[axis],0)/parts.length)};return{closed:closed2,points:Array.from({
length:count},(_,k)=>near2(whole*k/(closed2?count:count-1),k))}}var PathTool=class{constructor(store,scene,done){this.store=store,this.scene=scene,this.done=done,
this.name="path",this.stroke=null,this.hint="Press, draw the curve that a point of the body is to trace, and let go; where the ends meet it closes. Enter puts a\
n oval in the middle, Escape gives up.",this.line=s("path",{class:"bs-draft bs-draft-path"}),scene.layer("tool").append(this.line)}click(){}drag(point2,held){return this.
stroke??=[[held.from.X,held.from.Y]],this.stroke.push([point2.X,point2.Y]),put(this.line,"d",`M${this.stroke.map(each2=>each2.map(px).join(" ")).join("L")}`),!0}release(){
let{stroke}=this;this.stroke=null,put(this.line,"d",""),stroke?.slice(1).reduce((sum,[x,y],k)=>sum+Math.hypot(x-stroke[k][0],y-stroke[k][1]),0)>LEAST_LENGTH&&this.
finish(resampled(stroke,{meets:MEETS,apart:APART,smooth:SMOOTHED}))}finish({points,closed:closed2}){let{store,scene}=this,{view}=scene,there2=points.map(([X,Y])=>[
scene.rounded(view.x(X)),scene.rounded(view.y(Y))]),{document:document2,options}=store,{picture}=store;isPath(document2)?store.replace({document:pathDocument(document2,
there2,closed2),options,picture}):store.replace({picture,document:pathDocument({length_unit:document2.length_unit,angle_unit:"deg",poses:[]},there2,closed2),options,
name:"path"}),store.select(null),scene.use(null),this.done?.(points.length,closed2)}key(event){if(event.key==="Escape")this.scene.use(null);else if(event.key===
"Enter")this.finish(this.oval());else return!1;return!0}oval(){let{width,height}=this.scene.size,size2=.2*Math.min(width,height);return{points:Array.from({length:OVAL},
(_,k)=>2*Math.PI*k/OVAL).map(a=>[width/2+1.5*size2*Math.cos(a),height/2-size2*Math.sin(a)]),closed:!0}}end(){this.line.remove()}};var PathPanel=class{constructor(store,scene){this.store=store,this.title=h("h3",{}),this.closed=tick("closed: the last point leads back to the first",on=>store.
edit(document2=>setPath(document2,{closed:on})),{"data-key":"path-closed"}),this.fields=["x","y"].map(key=>({key,field:new NumberField({label:`how far points ma\
y be missed in ${key}`,options:()=>({kind:"length",unit:store.document.length_unit,optional:!0,least:0}),step:()=>scene.step/10,commit:value=>store.edit(document2=>setUsual(
document2,key,value)),attributes:{"data-key":`usual-${key}`,placeholder:"–"}})})),this.hint=h("p",{class:"bs-hint"}),this.element=h("div",{class:"bs-path-pane\
l","data-details":"path"},this.title,this.closed.element,h("div",{class:"bs-row"},h("span",{class:"bs-label"},"Points may be missed by"),this.fields.map(({key,field})=>labelled(
key,field.element))),this.hint),store.on("document",()=>this.draw()),this.draw()}draw(){let{document:document2}=this.store,count=document2.poses.length,path2=isPath(
document2),timed=document2.path?.crank_deg;if(give(this.element,"hidden",!isOfPoints(document2)),!this.element.hidden){say(this.title,path2?`A path of ${count} \
points${timed?", timed by the crank":""}`:`${count} point${count===1?"":"s"}`),give(this.closed.box,"checked",!!document2.path?.closed);for(let{key,field}of this.
fields)field.show(document2.tolerance?.[key]||void 0);say(this.hint,path2?"Blank: as near as possible, and of what is about as near the one that transmits best.":
"Nine points are met exactly by finitely many linkages, all of which are found; more are a path, which is met as nearly as possible.")}}};var BODY_AXIS=AXIS+10,LETTER2=14,TURNING_ARROW="M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9",BLOCK_IN_SLOT=[18,10],SPARE2=5,NAME=15,ARROW=24;function mechanism(data,linkage,view,places){
let drawn=new Mechanism(linkage);return drawn.shape(data,linkage,view,places),drawn}var Mechanism=class{constructor({led,drawn:links=[],ground,names}){this.kinds=
kindsOf(led),this.outline=s("path",{class:"bm-body-outline"}),this.links=s("g"),this.blocks=s("g"),this.pins=s("g"),this.coupler=s("g",{class:"bm-coupler"}),this.
arrow=s("path",{class:"bm-drive-mark bm-side0"}),this.letter=s("text",{class:"bm-letter","text-anchor":"middle"},"M"),this.plates=[s("path",{class:"bm-plate-rim"}),
s("path",{class:"bm-plate"})],this.coupler.append(...this.plates),this.parts=led.map((dyad,side)=>new PARTS[dyad.kind](this,side)),links.length&&this.parts.push(
...links.map(link=>new JointedLink(this,link)),new Joints(this,ground,names)),this.coupler.append(s("path",{class:"bm-body-frame",d:axes(BODY_AXIS)}),s("circle",
{class:"bm-origin",r:4}));for(let part of this.parts)part.pin&&this.coupler.append(part.pin);this.marks=new LoadMarks,this.group=s("g",{class:"bm-linkage"},this.
arrow,this.links,this.coupler,this.blocks,this.pins,this.marks.group,links.length?null:this.letter)}fits({led}){return kindsOf(led)===this.kinds}shape(data,linkage,view,places){
this.view=view,this.led=linkage.led,this.hasBody=!!data.body,this.hasBody?(put(this.outline,"d",bodyOutline(data,view)),this.outline.parentNode||this.group.prepend(
this.outline)):this.outline.remove();let corners=[[0,0]];linkage.led.forEach((dyad,side)=>{dyad.moving_pivot&&corners.push(inBody(dyad.moving_pivot,view));let more=this.
parts[side].shape(dyad,view,places);more&&corners.push(more)});let d=`M${hull(corners).map(corner=>corner.map(px).join(" ")).join("L")}Z`;for(let plate2 of linkage.
drawn?[]:this.plates)put(plate2,"d",d);for(let part of this.parts.slice(linkage.led.length))part.shape(view);this.marks.shape(data,linkage,view),this.shapeArrow()}show(place,drive=null){
let{view}=this,at=transform(view.X(place.x),view.Y(place.y),place.a);this.marks.show(place,drive),put(this.coupler,"transform",at),this.hasBody&&put(this.outline,
"transform",at);for(let part of this.parts)part.show(place);let[x,y]=act(place,[LETTER2/view.scale,-LETTER2/view.scale]);put(this.letter,"transform",`translate(${px(
view.X(x))} ${px(view.Y(y)+4)})`);let[driver]=this.led;driver.kind==="PR"&&put(this.arrow,"transform",`${onRail(driver,place,view)} translate(0 ${-ARROW})`)}shapeArrow(){
let{arrow:arrow2,view}=this,[driver]=this.led;if(driver.kind==="PR"&&put(arrow2,"d","M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5"),!driver.fixed_pivot)return;let[x,
y]=driver.fixed_pivot;put(arrow2,"d",TURNING_ARROW),put(arrow2,"transform",`translate(${px(view.X(x))} ${px(view.Y(y))}) rotate(-90)`)}},kindsOf=led=>led.map(dyad=>dyad.
kind).join(),inBody=([x,y],view)=>[view.scale*x,-view.scale*y];function onRail(dyad,place,view){let[x,y]=act(place,dyad.moving_pivot),[nx,ny]=normalOf(dyad);return transform(
view.X(x),view.Y(y),Math.atan2(nx,-ny))}var block=(side,width,height)=>s("g",{class:`bm-block bm-side${side}`},s("rect",{x:-width/2,y:-height/2,width,height,rx:2}));
function setPin(pin,[x,y],dyad){put(pin,"cx",px(x)),put(pin,"cy",px(y)),put(pin,"data-dyad",dyad.id)}var inGround=([x,y],view)=>[view.X(x),view.Y(y)],Bar=class{constructor({
links,pins},side){this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"bm-core"})],this.bar=s("g",{class:`bm-link bm-side${side}`},this.strokes),this.ground=
s("circle",{class:"bm-pin bm-fixed-pin",r:4.5}),this.pin=s("circle",{class:"bm-pin",r:4.5}),links.append(this.bar),pins.append(this.ground)}shape(dyad,view){this.
dyad=dyad,this.view=view;for(let stroke of this.strokes)put(stroke,"d",`M0 0H${px(view.scale*dyad.radius)}`);setPin(this.ground,inGround(dyad.fixed_pivot,view),
dyad),setPin(this.pin,inBody(dyad.moving_pivot,view),dyad)}show(place){let{dyad,view}=this,[cx,cy]=dyad.fixed_pivot,[x,y]=act(place,dyad.moving_pivot);put(this.
bar,"transform",transform(view.X(cx),view.Y(cy),Math.atan2(y-cy,x-cx)))}},BlockOnRail=class{constructor({blocks},side){this.block=block(side,...BLOCK),this.pin=
s("circle",{class:"bm-pin",r:4.5}),blocks.append(this.block)}shape(dyad,view){this.dyad=dyad,this.view=view,put(this.block,"data-dyad",dyad.id),setPin(this.pin,
inBody(dyad.moving_pivot,view),dyad)}show(place){put(this.block,"transform",onRail(this.dyad,place,this.view))}},Slot=class{constructor({blocks,pins,coupler},side){
this.strokes=["rim","plate","edge"].map(name=>s("path",{class:`bm-slot-${name}`})),this.strokes.push(s("path",{class:"bm-slot"})),this.block=block(side,...BLOCK_IN_SLOT),
this.ground=s("circle",{class:"bm-pin bm-fixed-pin",r:4}),coupler.append(...this.strokes),blocks.append(this.block),pins.append(this.ground)}shape(dyad,view,places){
this.dyad=dyad,this.view=view;let[low,high]=places.length?travelOf(dyad,places):[0,0],end=(BLOCK_IN_SLOT[0]/2+SPARE2)/view.scale,seen2=along2=>inBody(pointOnLine(
dyad,along2),view),d=`M${[seen2(low-end),seen2(high+end)].map(each2=>each2.map(px).join(" ")).join("L")}`;for(let stroke of this.strokes)put(stroke,"d",d);for(let part of[
this.strokes[3],this.block])put(part,"data-dyad",dyad.id);return setPin(this.ground,inGround(dyad.fixed_pivot,view),dyad),seen2((low+high)/2)}show(place){let{dyad,
view}=this,[nx,ny]=normalOf(dyad),[cx,cy]=dyad.fixed_pivot;put(this.block,"transform",transform(view.X(cx),view.Y(cy),place.a+Math.atan2(nx,-ny)))}},JointedLink=class{constructor({
links},{joints,kind}){this.joints=[...joints],this.strokes=[s("path",{class:"bm-bar"}),s("path",{class:"bm-core"})],links.append(s("g",{class:`bm-link bm-${kind}${joints.
length>2?" bm-ternary":""}`,"data-link":joints.replace("M","")},this.strokes))}shape(view){this.view=view}show(place){let d=`M${this.joints.map(joint=>inGround(
place.joints[joint]??[place.x,place.y],this.view).map(px).join(" ")).join("L")}${this.joints.length>2?"Z":""}`;for(let stroke of this.strokes)put(stroke,"d",d)}},
Joints=class{constructor({pins},ground,names){this.pins=[...Object.keys(ground),...Object.keys(names)].map(joint=>{let pin=s("circle",{class:`bm-pin${joint in ground?
" bm-fixed-pin":""}`,r:4.5,"data-joint":joint});return{joint,pin,link:[...names[joint]??""],name:joint in ground?null:s("text",{class:"bm-name","text-anchor":"m\
iddle"},joint)}}),pins.append(...this.pins.map(({pin})=>pin),...this.pins.flatMap(({name})=>name??[]))}shape(view){this.view=view}show({joints}){for(let{joint,pin,
link,name}of this.pins){let[x,y]=inGround(joints[joint],this.view);if(put(pin,"cx",px(x)),put(pin,"cy",px(y)),!name)continue;let[u,v]=outwards(link.map(each2=>inGround(
joints[each2],this.view)),[x,y]);put(name,"x",px(x+NAME*u)),put(name,"y",px(y+NAME*v+4))}}};function outwards(corners,[x,y]){let middle2=[0,1].map(k=>corners.reduce(
(sum,corner)=>sum+corner[k],0)/corners.length),u=x-middle2[0],v=y-middle2[1],size2=Math.hypot(u,v);return size2>1?[u/size2,v/size2]:[0,-1]}var Nothing=class{shape(){}show(){}},
PARTS={RR:Bar,PR:BlockOnRail,RP:Slot,PP:Nothing,crank:Nothing};var GRAVITY=9.80665,SCALED=["free_length","greatest_length","least_length","length","stroke","rate_Nm_per_deg"];function about([x,y],{turn=0,scale=1,mirror=!1}){
let[u,v]=linear2({turn,scale,mirror},[x,y]);return{turn,scale,mirror,x:x-u,y:y-v}}var quarters=({turn})=>Number.isInteger(turn/90)?(turn/90%4+4)%4:NaN;function linear2(by,[
x,y]){let q=quarters(by),a=radians(by.turn),[c,s2]=Number.isNaN(q)?[Math.cos(a),Math.sin(a)]:[[1,0],[0,1],[-1,0],[0,-1]][q],v=by.mirror?-y:y;return[by.scale*(c*
x-s2*v),by.scale*(s2*x+c*v)]}function moved(by,point2){let[x,y]=linear2(by,point2);return[tidy(x+by.x),tidy(y+by.y)]}function composed(by,before){let[x,y]=moved(
by,[before.x,before.y]);return{turn:direction(by,before.turn),scale:by.scale*before.scale,mirror:by.mirror!==before.mirror,x,y}}var direction=(by,angle)=>tidy(by.
turn+(by.mirror?-angle:angle)),inBody2=({scale,mirror})=>({turn:0,scale,mirror,x:0,y:0}),changed=(table3,changes)=>table3&&withKeys(table3,Object.fromEntries(Object.
entries(changes).filter(([key])=>table3[key]!==void 0).map(([key,change])=>[key,change(table3[key])]))),each=(list,change)=>list===void 0?void 0:Array.isArray(list)?
list.map(change):change(list);function movedRegion(by,region){let[shape]=["point","line","segment","box","polygon"].filter(key=>region[key]);if(shape==="point")
return{...region,point:moved(by,region.point)};let points=region[shape].map(point2=>moved(by,point2));if(shape==="polygon")return{...region,polygon:by.mirror?points.
reverse():points};if(shape!=="box")return{...region,[shape]:points};let[[a,b],[c,d]]=region.box,all=k=>points.map(point2=>point2[k]);return Number.isNaN(quarters(
by))?a===c&&b===d?withKeys(region,{box:void 0,point:points[0]}):a===c||b===d?withKeys(region,{box:void 0,segment:points}):withKeys(region,{box:void 0,polygon:boxCorners(
region.box).map(point2=>moved(by,point2))}):{...region,box:[[Math.min(...all(0)),Math.min(...all(1))],[Math.max(...all(0)),Math.max(...all(1))]]}}var swapped=(by,key)=>quarters(
by)%2===1?{x:"y",y:"x"}[key]??key:key;function movedTolerance(by,stated){let size2=bound=>typeof bound=="number"?tidy(by.scale*bound):bound,fixed2=stated.axes!==
"body",bounds2=["x","y"].filter(key=>stated[key]!==void 0).map(key=>[fixed2?swapped(by,key):key,size2(stated[key])]);return{...withKeys(stated,{x:void 0,y:void 0}),
...Object.fromEntries(bounds2)}}function movedPose(by,pose){let[x,y]=moved(by,[pose.x??0,pose.y??0]),there2={x,y,...pose.angle===void 0?{}:{angle:direction(by,pose.
angle)}};for(let key of["x","y"])pose[key]===void 0&&delete there2[swapped(by,key)];return{...withKeys(pose,{x:void 0,y:void 0,angle:void 0}),...there2,...changed(
{free:pose.free,tolerance:pose.tolerance},{free:keys=>keys.map(key=>swapped(by,key)),tolerance:stated=>movedTolerance(by,stated)})}}function withPosesMoved(document2,indices,by){
let chosen=new Set(indices);return aslant({poses:document2.poses.filter((_,k)=>chosen.has(k)),tolerance:document2.tolerance},by)?null:withKeys(document2,{poses:document2.
poses.map((pose,k)=>chosen.has(k)?movedPose(by,pose):pose)})}function aslant({poses,tolerance},by){if(!Number.isNaN(quarters(by)))return"";let differs=stated=>stated&&
stated.axes!=="body"&&!!(stated.x||stated.y)&&!(stated.x==="free"&&stated.y==="free"),index=poses.findIndex(pose=>(pose.free??[]).filter(key=>key!=="angle").length===
1||differs(pose.tolerance)),which=index>=0?`pose ${index+1}`:differs(tolerance)?"the poses":"";return which&&`Only quarter turns are possible: ${which} may be m\
issed along the axes of the ground, and they have no others.`}function movedSpring(by,spring){let body=inBody2(by),end=({link="ground",point:point2=[0,0]})=>({link,
point:moved(link==="ground"?by:body,point2)}),lengths=Object.fromEntries(SCALED.map(key=>[key,value=>tidy(by.scale*value)])),[from,to]=[spring.from?.link??"grou\
nd",spring.to?.link??(spring.ground_point?"body":"ground")],turned=+(from==="ground")-+(to==="ground");return changed(spring,{...lengths,ground_point:point2=>moved(
by,point2),body_point:point2=>moved(body,point2),from:end,to:end,rate_N_per_mm:rate=>tidy(rate/by.scale),free_deg:angle=>tidy((by.mirror?-angle:angle)+turned*by.
turn)})}function movedLoads(by,loads){let body=inBody2(by),turned=(frame,vector)=>linear2({...frame,scale:1},vector).map(tidy),{gravity="down"}=loads,pull=gravity===
"none"?gravity:turned(by,gravity==="down"?[0,-GRAVITY]:gravity),isDown=pull[0]===0&&pull[1]===-GRAVITY;return withKeys(changed(loads,{body:mass=>changed(mass,{center:point2=>moved(
body,point2),inertia_kgm2:value=>tidy(by.scale**2*value)}),links:links=>changed(links,links.plate===void 0?{}:{width:value=>tidy(by.scale*value)}),force:list=>each(
list,force=>({...force,at:moved(body,force.at),force_N:turned(force.frame==="M"?body:by,force.force_N)})),torque_Nm:torque=>tidy((by.mirror?-1:1)*by.scale*torque),
hand:hand=>({...hand,at:moved(body,hand.at)})}),{gravity:isDown?void 0:pull})}function transformed(document2,by,sigma=document2.pose_sigma){let body=inBody2(by),
size2=value=>tidy(by.scale*value),cranked=angle=>tidy((by.mirror?-angle:angle)+(document2.crank?.absolute?by.turn:0)),line2=frame=>rail=>changed(rail,{direction_deg:angle=>direction(
frame,angle),through:region=>movedRegion(frame,region),travel:region=>movedRegion(frame,region)}),limits=table3=>changed(table3,{fixed_pivot:region=>movedRegion(
by,region),moving_pivot:region=>movedRegion(body,region),rail:line2(by),slot:line2(body),length:range2=>changed(range2,{least:size2,most:size2})}),poses=document2.
poses.map(pose=>changed(movedPose(by,pose),{crank_deg:cranked})),loads=(document2.loads??document2.springs??document2.drive)&&movedLoads(by,document2.loads??{});
return withKeys(changed(document2,{tolerance:stated=>movedTolerance(by,stated),path:path2=>changed(path2,{crank_deg:list=>list.map(cranked)}),body:corners=>Array.
isArray(corners)?movedRegion(body,{polygon:corners}).polygon:corners,keep_out:list=>each(list,region=>region.file?region:movedRegion(by,region)),surroundings:table3=>changed(
table3,{link_width:size2,margin:size2}),limits:list=>each(list,limits),requirements:table3=>changed(table3,{footprint:region=>movedRegion(by,region),within:size2,
driver_torque_Nm:size2,body_speed:size2,body_acceleration:size2}),springs:list=>each(list,spring=>movedSpring(by,spring))}),{poses,loads:loads&&Object.keys(loads).
length?loads:void 0,pose_sigma:sigma&&(sigma.position||sigma.angle_deg)?{...sigma,position:size2(sigma.position)}:document2.pose_sigma})}function middleOfPoses(document2){
let places=document2.poses.map((_,k)=>standing(document2,k)),middle2=key=>(Math.min(...places.map(each2=>each2[key]))+Math.max(...places.map(each2=>each2[key])))/
2;return places.length?[middle2("x"),middle2("y")]:[0,0]}var LONGEST_ARM=46,SHORTEST_ARM=27,FEW=24,MOST2=240,ROOM3=14,NAME2=14,LONGEST_NAME2=18,ARROWS2={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},
unwrapped=(angle,near2)=>angle+360*Math.round((near2-angle)/360),strideOf=({poses},scale)=>{let length=poses.slice(1).reduce((sum,{x,y},k)=>sum+(Math.hypot(x-poses[k].
x,y-poses[k].y)||0),0);return poses.length<=FEW?1:Math.ceil(poses.length/clamp(scale*length/ROOM3,FEW,MOST2))};function drawnPoses({document:document2,selection},scale){
let{poses}=document2,count=poses.length,all=[...poses.keys()];if(count<=FEW)return all;let stride=strideOf(document2,scale),chosen=selection?.kind==="pose"?selection.
indices??[selection.index]:[];return all.filter(k=>k%stride===0||k===count-1||chosen.includes(k))}var PoseHandles=class{constructor(store,scene){this.store=store,
this.scene=scene,this.element=scene.layer("poses"),this.names=scene.layer("labels"),this.kept=new Kept(this.element,k=>this.make(k),(group,k)=>this.show(group,k)),
this.labels=new Kept(this.names,()=>s("text",{class:"bs-pose-name"}),(text,k)=>this.showName(text,k)),store.on("document selection reference",()=>this.draw()),scene.
on("view",()=>this.draw()),scene.on("marquee",([x,y,u,v])=>store.selectPoses([...store.document.poses.keys()].filter(k=>{let at=standing(store.document,k);return at.
x>=x&&at.x<=u&&at.y>=y&&at.y<=v}))),scene.on("key",event=>store.selectedPoses.length>0&&this.key(event,store.selection.index,!1)),scene.hold(()=>store.document.
poses.map((_,k)=>standing(store.document,k)).map(({x,y})=>[x,y])),scene.on("click",()=>store.select(null)),scene.names.avoid(()=>this.obstacles()),this.draw()}get arm(){
let{document:document2}=this.store,{scale}=this.scene.view,places=drawnPoses(this.store,scale).map(k=>standing(document2,k)),away2=places.slice(1).map(({x,y},k)=>scale*
Math.hypot(x-places[k].x,y-places[k].y)).sort((a,b)=>a-b);return away2.length?clamp(1.2*away2[away2.length>>1],SHORTEST_ARM,LONGEST_ARM):LONGEST_ARM}draw(){this.
length=this.scene.dragged?this.length??this.arm:this.arm;let poses=drawnPoses(this.store,this.scene.view.scale).map(k=>[k,k]);this.kept.draw(poses),this.labels.
draw(poses.length>FEW&&isPath(this.store.document)?[]:poses)}make(k){let origin=s("g",{class:"bs-origin","data-pose":k+1,tabindex:0,role:"button"},s("circle",{class:"\
bs-hold",r:12}),s("circle",{class:"bs-dot",r:5.5})),turn=s("g",{class:"bs-turn","data-turn":k+1,tabindex:0,role:"slider","aria-valuemin":-360,"aria-valuemax":360},
s("circle",{class:"bs-hold",r:12}),s("circle",{class:"bs-tip",r:5})),group=s("g",{class:"bs-pose"},s("path",{class:"bs-axes"}),origin,turn);this.dragOrigin(origin,
k),this.dragTurn(turn,k);for(let part of[origin,turn])part.addEventListener("focus",()=>this.touch(k));return origin.addEventListener("keydown",event=>this.key(
event,k,!1)),turn.addEventListener("keydown",event=>this.key(event,k,!0)),group}show(group,k){let{store,scene:{view}}=this,{x,y,angle}=standing(store.document,k),
pose=store.document.poses[k],selected=store.selectedPoses.includes(k),isReference=store.referenceIndex===k,unit2=store.document.length_unit??"",name=poseName2(store.
document,k),point2=isPoint2(pose);if(!isOther(group,[view,this.length,x,y,angle,!!pose.exact,pose.name,name,unit2,selected,isReference,point2]))return;let[arrow2,
origin,turn]=group.children;put(group,"transform",transform(view.X(x),view.Y(y),point2?0:radians(angle)));for(let part of[arrow2,turn])put(part,"display",point2?
"none":"inline");group.classList.toggle("bs-point",point2),put(arrow2,"d",axes(this.length-8)),put(turn,"transform",`translate(${px(this.length)} 0)`),group.classList.
toggle("bs-selected",selected),group.classList.toggle("bs-reference",isReference),group.classList.toggle("bs-exact",!!pose.exact);let what=point2?"Point":"Pose",
called=pose.name?`${what} ${k+1}, ${name}`:`${what} ${k+1}`;put(origin,"aria-label",`${called}: x ${x} ${unit2}, y ${y} ${unit2}, ${point2?"angle free":`angle ${angle}\
°`}. Drag, or use the arrow keys; Delete removes it.`),put(origin,"aria-pressed",selected),put(turn,"aria-label",`Turn ${called}`),put(turn,"aria-valuenow",angle),
put(turn,"aria-valuetext",`${angle}°`)}obstacles(){let{store,scene:{view},length}=this,boxes=[];for(let k of drawnPoses(store,view.scale)){let{x,y,angle}=standing(
store.document,k),a=radians(angle),[c,d]=[Math.cos(a),Math.sin(a)],at=(along2,across,size2)=>boxes.push([view.X(x)+along2*c-across*d,view.Y(y)-along2*d-across*c,
size2,size2]);if(at(0,0,13),!isPoint2(store.document.poses[k])){at(length,0,12),at(LETTER2,-LETTER2,12);for(let share of[.35,.7])at(share*length,0,6);for(let share of[
.3,.6])at(0,share*(length-8),6)}}return boxes}showName(text,k){let{store,scene}=this,{view}=scene,{x,y,angle}=standing(store.document,k),isHere=store.isOnBody&&
k===store.referenceIndex,name=`${shortened(poseName2(store.document,k),LONGEST_NAME2)}${isHere?": drawn here":""}`;text.classList.toggle("bs-reference",k===store.
referenceIndex),isOther(text,[view,x,y,angle,name])&&(say(text,name),scene.names.put(text,view.X(x),view.Y(y),name,around(name,radians(angle+215),NAME2,scene.names.
areMany)))}set(k,changes,gesture){this.store.edit(document2=>setPose(document2,k,statedOf(document2.poses[k],changes)),{gesture})}touch(k){let{store,scene}=this;
scene.pressed?.shiftKey||(store.selectedPoses.includes(k)?store.selectPoses(store.selectedPoses,k):store.select({kind:"pose",index:k}))}click(event,k){return event.
shiftKey?this.store.selectAlso(k):(this.store.select({kind:"pose",index:k}),this.openField(k))}heldWith(k){let{store}=this;return store.selectedPoses.includes(k)||
store.select({kind:"pose",index:k}),store.selectedPoses}openField(k){let{store,scene}=this,isThere=()=>store.selectedPoses.includes(k),point2=isPoint2(store.document.
poses[k]);scene.field.open({name:`pose ${k+1}`,kind:"pose",at:()=>isThere()&&Object.values(standing(store.document,k)).slice(0,2),values:()=>standing(store.document,
k),fields:[["x","x","length"],["y","y","length"],...point2?[]:[["angle","angle °","angle"]]],set:changes=>this.set(k,changes,null)})}moveAll(before,indices,by,gesture){
let next=withPosesMoved(before,indices,by);next&&this.store.edit(document2=>({...document2,poses:next.poses}),{gesture})}dragOrigin(element,k){let{store,scene}=this,
gesture,off,before,reach,start,held;scene.drag(element,{start:from=>{let{x,y}=standing(store.document,k);gesture=Symbol("move a pose"),start=[x,y],off=[x-from.x,
y-from.y],before=store.document,reach=isPath(before)?strideOf(before,scene.view.scale):1,held=this.heldWith(k),this.openField(k)},move:(point2,event)=>{let to=scene.
snap.point([point2.x+off[0],point2.y+off[1]],{event,from:start,skip:of=>held.some(each2=>of.endsWith(`pose ${each2}`))});held.length>1?this.moveAll(before,held,
{turn:0,scale:1,mirror:!1,x:to[0]-start[0],y:to[1]-start[1]},gesture):reach>1?this.bend(before,k,reach,[to[0]-start[0],to[1]-start[1]],gesture):this.set(k,{x:to[0],
y:to[1]},gesture)},cancel:()=>store.abandon(gesture),click:event=>this.click(event,k)})}bend({poses,path:path2},k,reach,[dx,dy],gesture){let count=poses.length,
moved2=poses.map((pose,j)=>{let away2=path2?.closed?Math.min(Math.abs(j-k),count-Math.abs(j-k)):Math.abs(j-k),share=1-away2/reach;return share>0?{...pose,x:this.
scene.rounded(pose.x+share*dx),y:this.scene.rounded(pose.y+share*dy)}:pose});this.store.edit(document2=>({...document2,poses:moved2}),{gesture})}dragTurn(element,k){
let{store,scene}=this,gesture,off,before,held,angleTo=point2=>{let{x,y}=standing(store.document,k);return degrees(Math.atan2(point2.y-y,point2.x-x))};scene.drag(
element,{start:from=>{gesture=Symbol("turn a pose"),before=store.document,held=this.heldWith(k),off=standing(before,k).angle-angleTo(from),this.openField(k)},move:(point2,event)=>{
let{x,y,angle:now}=standing(store.document,k),angle=scene.snap.angle(unwrapped(angleTo(point2)+off,now),[point2.x,point2.y],{event,skip:k});held.length>1?this.moveAll(
before,held,about([x,y],{turn:angle-standing(before,k).angle}),gesture):this.set(k,{angle},gesture)},cancel:()=>store.abandon(gesture),click:event=>this.click(event,
k)})}key(event,k,turning){let{store,scene}=this,arrow2=ARROWS2[event.key],held=store.selectedPoses.includes(k)?store.selectedPoses:[k];if(event.ctrlKey||event.metaKey)
return!1;if(arrow2){event.repeat||(this.keyed=Symbol("keys"));let{x,y,angle}=standing(store.document,k),by=stepOf(event,turning?1:scene.step);held.length>1&&turning?
this.moveAll(store.document,held,about([x,y],{turn:by*(arrow2[0]===0?arrow2[1]:-arrow2[0])}),this.keyed):held.length>1?this.moveAll(store.document,held,{turn:0,
scale:1,mirror:!1,x:by*arrow2[0],y:by*arrow2[1]},this.keyed):turning?this.set(k,{angle:stepped(angle,by*(arrow2[0]===0?arrow2[1]:-arrow2[0]))},this.keyed):this.
set(k,{x:stepped(x,by*arrow2[0]),y:stepped(y,by*arrow2[1])},this.keyed)}else if(event.key==="Delete"||event.key==="Backspace"){store.edit(document2=>removePoses(
document2,held));let left=store.document.poses.length,next=Math.min(held.length>1?held[0]:k,left-1);store.select(left?{kind:"pose",index:next}:null),this.focus(
next)}else return!1;return event.preventDefault(),!0}focus(k){this.element.querySelector(`[data-pose="${k+1}"]`)?.focus({preventScroll:!0})}},PointTool=class{constructor(store,scene){
this.store=store,this.scene=scene,this.name="point",this.hint="Click where the body's point is to pass; how the body turns there is free. Escape ends."}click(point2,event){
let{store,scene}=this,index=store.document.poses.length,[x,y]=scene.snap.point([point2.x,point2.y],{event});store.edit(document2=>setAngle(addPose(document2,{x,
y}),index,void 0)),store.select({kind:"pose",index})}key(event){return event.key!=="Escape"?!1:(this.scene.use(null),!0)}},PoseTool=class{constructor(store,scene){
this.store=store,this.scene=scene,this.name="pose",this.gesture=null,this.hint="Click where the pose is to stand, and click again to turn it. Escape ends."}click(point2,event){
let{store,scene}=this;if(this.gesture){this.turn(point2,event),this.gesture=null;return}let[x,y]=scene.snap.point([point2.x,point2.y],{event});this.gesture=Symbol(
"add a pose");let angle=store.document.poses.findLast(pose=>Number.isFinite(pose.angle))?.angle??0;store.edit(document2=>addPose(document2,{x,y,angle}),{gesture:this.
gesture}),store.select({kind:"pose",index:store.document.poses.length-1})}hover(point2,event){this.gesture&&point2?this.turn(point2,event):point2&&this.scene.snap.
point([point2.x,point2.y],{event})}turn(point2,event){let{store,gesture}=this,k=store.document.poses.length-1,{x,y,angle}=standing(store.document,k);if(Math.hypot(
point2.x-x,point2.y-y)*this.scene.view.scale<6)return;let next=this.scene.snap.angle(unwrapped(degrees(Math.atan2(point2.y-y,point2.x-x)),angle),[point2.x,point2.
y],{event,skip:k});store.edit(document2=>setPose(document2,k,{angle:next}),{gesture})}key(event){return event.key!=="Escape"?!1:(this.gesture&&this.store.abandon(
this.gesture),this.gesture=null,this.scene.use(null),!0)}};var PAGE=60,NUMBERS2=[["x","length"],["y","length"],["angle","angle"]],BOUNDS=[["x","x","length"],["y","y","length"],["angle","angle_deg","angle"]],oneLine=name=>(name??
"").replace(/[\r\n\u2028\u2029]+/g," "),PoseTable=class{exact;crank;weight;bounds;crankLine;constructor(store,scene){this.store=store,this.scene=scene,this.page=
0,this.rows=[],this.body=h("tbody",{}),this.unit=h("span",{class:"bs-unit"}),this.pages=h("div",{class:"bs-pages",hidden:!0}),this.details=h("div",{class:"bs-de\
tails","data-details":"pose"}),this.hint=h("p",{class:"bs-hint"},"A blank angle is free: then the row is a point, which the body passes at any angle."),this.table=
h("table",{class:"bs-poses","aria-label":"Poses"},h("thead",{},h("tr",{},h("th",{scope:"col"},"#"),h("th",{scope:"col"},"name"),h("th",{scope:"col"},"x"),h("th",
{scope:"col"},"y"),h("th",{scope:"col"},"angle °"))),this.body);let add=button("Add a pose",()=>this.add(),{"data-do":"add-pose-row"});this.element=h("div",{class:"\
bs-table-box"},this.table,this.pages,h("div",{class:"bs-row"},add,this.unit),this.hint,this.details),this.makeDetails(),this.pace=new Pace(()=>this.draw()),store.
on("document selection",()=>scene.dragged?this.pace.ask():this.draw()),scene.on("dropped",()=>this.pace.catchUp()),this.draw()}get selected(){let{selection,document:document2}=this.
store;return selection?.kind==="pose"&&selection.index<document2.poses.length?selection.index:null}draw(){let{document:document2}=this.store,count=document2.poses.
length,pages=Math.max(1,Math.ceil(count/PAGE));this.selected!==null&&this.selected!==this.shownSelection&&(this.page=Math.floor(this.selected/PAGE)),this.shownSelection=
this.selected,this.page=Math.min(this.page,pages-1);let first=this.page*PAGE,shown2=Math.min(PAGE,count-first);for(;this.rows.length<shown2;)this.rows.push(this.
makeRow(this.rows.length));for(;this.body.children.length>shown2;)this.body.lastChild.remove();for(let k=0;k<shown2;k+=1)(!this.rows[k].tr.isConnected||this.body.
children[k]!==this.rows[k].tr)&&this.body.append(this.rows[k].tr),this.showRow(this.rows[k],first+k);say(this.unit,document2.length_unit?`x and y in ${document2.
length_unit}`:""),this.showPages(pages,count),this.showDetails()}makeRow(place){let row={index:place,fields:{}},change=changes=>this.store.edit(document2=>setPose(
document2,row.index,changes));row.number=h("button",{type:"button",class:"bs-index",onclick:event=>event.shiftKey||event.ctrlKey||event.metaKey?this.store.selectAlso(
row.index):this.store.select(row.index===this.selected&&this.store.selectedPoses.length===1?null:{kind:"pose",index:row.index})}),row.name=textField("Name",text=>change(
{name:text.trim()||void 0}),{class:"bs-text bs-name",placeholder:"–"});let cells2=NUMBERS2.map(([key,kind])=>{let field=new NumberField({label:key,options:()=>({
kind,unit:this.store.document.length_unit,optional:key==="angle"||this.isFree(row.index,key)}),step:()=>kind==="angle"?1:this.scene.step,commit:value=>key==="an\
gle"?this.store.edit(document2=>setAngle(document2,row.index,value)):change({[key]:value}),attributes:{"data-key":key}});return row.fields[key]=field,h("td",{},
field.element)});return row.tr=h("tr",{class:"bs-pose-row"},h("th",{scope:"row"},row.number),h("td",{},row.name),cells2),row.tr.addEventListener("focusin",event=>event.
target!==row.number&&this.store.select({kind:"pose",index:row.index})),row}isFree(index,key){return isFree(this.store.document.poses[index],key)}showRow(row,index){
let pose=this.store.document.poses[index],moved2=row.index!==index,selected=this.store.selectedPoses.includes(index);if(row.index=index,!(!isOther(row.tr,[index,
pose,selected])&&document.activeElement?.closest("tr")!==row.tr)){put(row.tr,"data-row",index+1),row.tr.classList.toggle("bs-selected",selected),say(row.number,
index+1),put(row.number,"aria-label",`Pose ${index+1}`),put(row.number,"aria-pressed",selected),(moved2||document.activeElement!==row.name)&&give(row.name,"valu\
e",oneLine(pose.name)),put(row.name,"aria-label",`Name of pose ${index+1}`);for(let[key]of NUMBERS2){let{input}=row.fields[key],free=this.isFree(index,key);put(
input,"aria-label",`${key} of pose ${index+1}`),put(input,"placeholder",free?"free":""),row.fields[key].turnTo(index,pose[key]),row.fields[key].show(pose[key])}}}showPages(pages,count){
if(give(this.pages,"hidden",pages<2),pages<2)return;let go=page=>{this.page=page,this.draw()};this.pages.replaceChildren(button("‹",()=>go(Math.max(0,this.page-
1)),{"aria-label":"Earlier poses",disabled:this.page===0}),h("span",{},`${this.page*PAGE+1}–${Math.min(count,(this.page+1)*PAGE)} of ${count}`),button("›",()=>go(
Math.min(pages-1,this.page+1)),{"aria-label":"Later poses",disabled:this.page===pages-1}))}add(){let{store,scene}=this,count=store.document.poses.length,last=count?
standing(store.document,count-1):{x:0,y:0,angle:0},ofPoints=isOfPoints(store.document);store.edit(document2=>{let more=addPose(document2,count?{...last,x:scene.
rounded(last.x+10*scene.step)}:last);return ofPoints?setAngle(more,count,void 0):more}),store.select({kind:"pose",index:count});let field=this.rows.find(row=>row.
index===count&&row.tr.isConnected)?.fields.x.input;field?.focus(),field?.select()}makeDetails(){let{store}=this,at=()=>this.selected,edit=change=>store.edit(document2=>change(
document2,at()));this.title=h("h3",{class:"bs-pose-title"}),this.exact=tick("met exactly",on=>edit((document2,k)=>setPose(document2,k,{exact:on||void 0})),{"dat\
a-key":"exact"}),this.weight=new NumberField({label:"weight",options:()=>({optional:!0,above:0}),commit:value=>edit((document2,k)=>setPose(document2,k,{weight:value})),
attributes:{"data-key":"weight",placeholder:"1"}}),this.bounds=BOUNDS.map(([component2,key,kind])=>{let field=new NumberField({label:`tolerance of ${component2}`,
options:()=>({kind,unit:store.document.length_unit,optional:!0,least:0}),step:()=>kind==="angle"?1:this.scene.step,commit:value=>edit((document2,k)=>setTolerance(
document2,k,key,value)),attributes:{"data-key":`tolerance-${component2}`,placeholder:"–"}}),turned=(document2,k,on)=>setAngle(document2,k,on?void 0:standing(document2,
k).angle),free=tick("free",on=>edit((document2,k)=>component2==="angle"?turned(document2,k,on):setFree(document2,k,component2,on)),{"data-key":`free-${component2}`,
"aria-label":`${component2} is free`});return{component:component2,key,field,free}}),this.axes=choice("Axes of the tolerance",[["fixed","along the axes of the g\
round"],["body","along the axes of the body"]],value=>edit((document2,k)=>setTolerance(document2,k,"axes",value==="body"?value:void 0)),{"data-key":"tolerance-a\
xes"});let act2=(text,name,change,then)=>button(text,()=>{let k=at();edit(change),store.select(then(k)===null?null:{kind:"pose",index:then(k)})},{"data-do":name}),
last=()=>store.document.poses.length-1;this.up=act2("Earlier","earlier",(document2,k)=>movePose(document2,k,k-1),k=>k-1),this.down=act2("Later","later",(document2,k)=>movePose(
document2,k,k+1),k=>k+1),this.crank=new NumberField({label:"crank angle",options:()=>({kind:"angle"}),step:()=>1,commit:value=>edit((document2,k)=>setCrank(document2,
k,value)),attributes:{"data-key":"crank"}}),this.crankLine=labelled("crank angle °",this.crank.element),this.details.append(this.title,this.crankLine,h("div",{
class:"bs-row"},this.exact.element,labelled("weight",this.weight.element)),h("p",{class:"bs-hint"},"Tolerance: how far from it the body may be, to either side"),
h("table",{class:"bs-tolerances","aria-label":"Tolerance"},h("tbody",{},this.bounds.map(({component:component2,field,free})=>h("tr",{},h("th",{scope:"row"},component2===
"angle"?"angle °":component2),h("td",{},field.element),h("td",{},free.element))))),this.axes,h("div",{class:"bs-row"},this.up,this.down,act2("Duplicate","dupli\
cate",duplicatePose,k=>k+1),act2("Delete","delete-pose",removePose,k=>last()<0?null:Math.min(k,last()))))}showDetails(){let k=this.selected;if(give(this.details,
"hidden",k===null),k===null)return;let{poses}=this.store.document,pose=poses[k];if(!isOther(this.details,[k,pose,poses.length,this.store.document.path])&&!this.
details.contains(document.activeElement))return;let turned=this.store.document.path?.crank_deg?.[k];give(this.crankLine,"hidden",turned===void 0),this.crank.turnTo(
k,turned),this.crank.show(turned),this.title.replaceChildren(`${isPoint2(pose)?"Point":"Pose"} ${k+1}`,...pose.name?[": ",h("bdi",{},oneLine(pose.name))]:[]),give(
this.exact.box,"checked",!!pose.exact),this.weight.turnTo(k,pose.weight),this.weight.show(pose.weight);for(let{component:component2,key,field,free}of this.bounds){
let isFree2=this.isFree(k,component2)||pose.tolerance?.[component2]==="free";give(free.box,"checked",isFree2),give(field.input,"disabled",isFree2);let stated=pose.
tolerance?.[key],bound=typeof stated=="number"?stated:void 0;field.turnTo(k,bound),field.show(bound)}give(this.axes,"hidden",!pose.tolerance),give(this.axes,"va\
lue",pose.tolerance?.axes??"fixed"),give(this.up,"disabled",k===0),give(this.down,"disabled",k===poses.length-1)}};var LONGEST_NAME3=22,ABOVE=10,HATCH2=9,PIVOT2={fixed_pivot:"Fixed pivot",moving_pivot:"Moving pivot"};function limitName(document2,{table:table3,key}){return`${PIVOT2[key]}${limitsOf(
document2).length>1?` of dyad ${table3+1}`:""}`}function regionShape(region){return region.box?{shape:"box",points:region.box}:region.polygon?{shape:"polygon",points:region.
polygon}:null}var Regions=class{onjudged;constructor(store,scene){this.store=store,this.scene=scene,this.shapes=new Map,scene.layer("regions").append(s("defs",{},
s("pattern",{id:"bs-hatch",width:HATCH2,height:HATCH2,patternUnits:"userSpaceOnUse",patternTransform:"rotate(45)"},s("path",{class:"bm-hatch",d:`M0 0V${HATCH2}`})))),
this.regions=new Kept(s("g"),(key,k)=>this.makeRegion(k),element=>this.shapes.get(element).draw()),this.footprint=new Kept(s("g"),()=>this.makeFootprint(),element=>this.
shapes.get(element).draw()),this.limits=new Kept(s("g"),(key,limit)=>this.makeLimit(limit),element=>this.shapes.get(element).draw()),this.names=new Kept(s("g",{
class:"bs-region-names","aria-hidden":"true"}),()=>s("text",{}),(text,name)=>this.showName(text,name)),scene.layer("regions").append(this.regions.group,this.footprint.
group),scene.layer("limits").append(this.limits.group),scene.layer("labels").append(this.names.group),store.on("document",()=>this.judge(store.state==="dragging"&&
!this.isOther())),store.on("selection reference",()=>this.draw()),store.on("solved followed chosen placed",()=>this.judge()),scene.on("view",()=>this.draw()),scene.
hold(()=>limitRegions(store.document).filter(({shape})=>shape!=="line").flatMap(each2=>this.corners(each2))),scene.hold(()=>regionsOf(store.document).map(regionShape).
filter(Boolean).flatMap(({shape,points})=>outlineOf(shape,points)),!0),this.judge()}place({key}){return key==="moving_pivot"?referencePlace(this.store):GROUND}corners(limit){
return outlineOf(limit.shape,limit.points).map(point2=>act(this.place(limit),point2))}isOther(){let{body,keep_out,surroundings}=this.store.document;return[body,
keep_out,surroundings].some((each2,k)=>each2!==this.judged?.[k])}judge(pivots=!1){let{document:document2,solved}=this.store,linkage=currentLinkage(this.store);this.
broken=linkage?.led?limitsMissed(document2,linkage,solved?.scene??1):null,pivots||(this.judged=[document2.body,document2.keep_out,document2.surroundings],this.touched=
linkage?.led?regionsTouched(document2,linkage,bodyOf(document2)):null),this.draw(),this.onjudged?.()}said(table3,key){return this.broken?.[table3]?.filter(each2=>each2.
key===key).map(each2=>missedSentence(each2,this.store.document.length_unit))??null}draw(){let{document:document2}=this.store,regions=regionsOf(document2),limits=limitRegions(
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
this.store.edit(document2=>removeRegion(document2,k)),this.store.select(null),this.scene.svg.focus({preventScroll:!0})}makeLimit({table:table3,key}){let{store}=this,
place=()=>this.place({key}),at=()=>limitRegions(store.document).findIndex(each2=>each2.table===table3&&each2.key===key);return this.kept(new ShapeHandles(this.scene,
{className:`bs-limit bs-${key.replace("_","-")}`,what:()=>{let index=at(),limit=limitRegions(store.document)[index],said=this.said(table3,key);return{...limit,place:place(),
name:`Limit: ${limitName(store.document,limit)}`,selected:store.selection?.kind==="limit"&&store.selection.index===index,state:said?said.length?"broken":"met":"",
data:{limit:index,plane:key==="moving_pivot"?"M":"F"}}},set:(points,gesture)=>store.edit(document2=>setLimit(document2,table3,{[key]:shapeOf(Object.keys(limitsOf(
document2)[table3][key])[0],points)}),{gesture}),remove:()=>this.removeLimit(table3,key),select:()=>store.select({kind:"limit",index:at()}),abandon:gesture=>store.
abandon(gesture)}))}removeLimit(table3,key){this.store.edit(document2=>setLimit(document2,table3,{[key]:void 0})),this.store.select(null),this.scene.svg.focus({
preventScroll:!0})}makeFootprint(){let{store}=this,shape=()=>Object.keys(store.document.requirements.footprint)[0];return this.kept(new ShapeHandles(this.scene,
{className:"bs-footprint",what:()=>({shape:shape(),points:store.document.requirements.footprint[shape()],place:GROUND,name:"Footprint: holds all pivots",selected:store.
selection?.kind==="footprint",data:{footprint:""}}),set:(points,gesture)=>store.edit(document2=>setRequirement(document2,"footprint",{[shape()]:points}),{gesture}),
remove:()=>{store.edit(document2=>setRequirement(document2,"footprint",void 0)),store.select(null)},select:()=>store.select({kind:"footprint",index:0}),abandon:gesture=>store.
abandon(gesture)}))}showName(text,{text:name,at:[x,y],off,width}){let{scene}=this,{view}=scene,shown2=shortened(name,LONGEST_NAME3);say(text,shown2),put(text,"c\
lass",off?"bs-limit-name":"bs-region-name"),scene.names.put(text,view.X(x),view.Y(y),shown2,off?along(off,view.scale*(width??0)):[[0,0,0]])}regionTool(shape){let{
store}=this;return new ShapeTool(this.scene,{shape,name:`region ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>addRegion(document2,{[shape]:points})),
store.select({kind:"region",index:regionsOf(store.document).length-1})}})}limitTool(table3,key,shape){let{store}=this;return new ShapeTool(this.scene,{shape,name:`\
limit ${table3} ${key} ${shape}`,place:()=>this.place({key}),at:key==="moving_pivot"?atReference(store):"",done:points=>{store.edit(document2=>setLimit(document2,
table3,{[key]:shapeOf(shape,points)})),store.select({kind:"limit",index:limitRegions(store.document).findIndex(each2=>each2.table===table3&&each2.key===key)})}})}footprintTool(shape){
let{store}=this;return new ShapeTool(this.scene,{shape,name:`footprint ${shape}`,place:()=>GROUND,done:points=>{store.edit(document2=>setRequirement(document2,"\
footprint",{[shape]:points})),store.select({kind:"footprint",index:0})}})}};function middle(points){let[x,y,u,v]=bounds(points);return[(x+u)/2,(y+v)/2]}function middleOf(points,upper){
let[x,y,u,v]=bounds(points);return[(x+u)/2,upper?v:y]}function widthOf(points){let[x,,u]=bounds(points);return Number.isFinite(u-x)?u-x:0}function unfoldForPrint(root,signal){window.addEventListener("beforeprint",()=>{for(let part of detailsOf(root,":not([open])"))part.open=!0,part.dataset.opened=
""},{signal}),window.addEventListener("afterprint",()=>{for(let part of detailsOf(root,"[data-opened]"))part.open=!1,delete part.dataset.opened},{signal})}var detailsOf=(root,which)=>root.
querySelectorAll(`details${which}`);var Events=class{heard;on(names,fn){this.heard??=new Map;for(let name of names.split(" "))this.heard.set(name,[...this.heard.get(name)??[],fn])}emit(name,...values){
for(let fn of this.heard?.get(name)??[])fn(...values)}};var LONGEST_NAME4=5,FOLLOWED=1e-7,EXACT_TURN=1e-5,UNSEEN=1e-6,PLACED="placed",NOTHING={poses:[],body:null,keep_out:[],loads:null,scene:1,unit:null,dyads:[],linkages:[],
dyads_title:"Dyads",chart:{origin:[0,0],angle:0,length:1},space:{centre:[0,0,0],half:[1,1,1],quadrics:[]},pivot_map:null,family_map:null,transmission_limit:{deg:40,
said:"40°, a usual limit"},keys:[],table:null,best:[],warnings:[],footnotes:""},Answers=class extends Events{constructor(store){super(),this.store=store,this.data=
{...NOTHING},this.linkages=[],this.gone=[],this.byId=new Map,this.placed=null,store.on("solved",()=>this.takeSolved()),store.on("followed",()=>this.takeFollowed()),
store.on("document",()=>this.takePoses()),store.on("chosen",()=>this.emit("shown")),store.on("placed",()=>this.takePlaced()),this.takePoses(),store.solved&&this.
takeSolved()}get shown(){return this.get(this.store.chosen)??(this.store.chosen===PLACED?void 0:this.linkages[0])}get(id){return id===PLACED?this.placed??void 0:
this.byId.get(id)}get isOld(){return this.store.solvedFor!==this.store.document}takePoses(){let poses=posesOf(this.store.document);Object.assign(this.data,{poses,
isPath:isPath(this.store.document),...surroundingsOf(this.store.document,this.data)}),this.emit("poses")}takeSolved(){let{solved,document:document2}=this.store,
before=this.linkages.filter(each2=>!each2.gone),{renamed:names,moved:moved2}=this.store,was=new Map([...names].map(([old,id])=>[id,this.byId.get(old)])),{poses,
body,keep_out,...rest}=solved;Object.assign(this.data,{body,keep_out,...rest,poses:posesOf(document2)}),this.gone=this.store.isEmpty||this.store.isAnother?[]:before.
filter(each2=>!names.has(each2.id)).map(each2=>each2.id),this.byId=new Map,this.linkages=solved.linkages.map(fresh=>{let kept2=was.get(fresh.id),now=kept2??{},stood=kept2&&
kept2.rank!==1/0,before2=stood&&kept2.id!==fresh.id?kept2.id:null;for(let key of Object.keys(now))delete now[key];return Object.assign(now,figured(linked(fresh)),
{was:before2,shift:moved2.get(fresh.id)??0,isNew:this.known&&!this.store.isAnother&&!stood,followed:!1,gone:null,change:null}),this.byId.set(now.id,now),now}),this.
known=!this.store.isEmpty,this.emit("answers")}takeFollowed(){let frame=this.store.followed;if(frame){for(let each2 of frame.linkages){let now=this.byId.get(each2.
id);now&&each2.fresh===!1||(now||(now=appeared(each2),this.byId.set(each2.id,now),this.linkages.push(now),this.hasNew=!0),follow(now,each2,this.data))}for(let{id,
message}of frame.vanished??[]){let now=this.byId.get(id);now&&Object.assign(now,{gone:message,usable:!1})}for(let{id,kind,message}of frame.changes??[]){let now=this.
byId.get(id);now&&kind!=="vanished"&&(now.change=message)}this.hasNew?(this.hasNew=!1,this.emit("answers")):this.emit("moved")}}takePlaced(){let placed=this.store.
placed?.linkage,{cognateOf}=this.store.placed??{},called=cognateOf?`Cognate of ${cognateOf}`:"By hand",before=this.placed;this.placed=placed?Object.assign(before??
{},figured(linked(placed)),{id:PLACED,called,gone:null,followed:!1}):null,this.emit("placed"),this.store.chosen===PLACED&&this.emit(before&&placed?"moved":"show\
n")}},linked=linkage=>({...linkage,pose_errors:linkage.pose_errors.map(row=>({...row,at:row.way===null?null:linkage.ways[row.way]}))}),figured=linkage=>Object.assign(
linkage,{worst:linkage.position_error.max,least:linkage.min_transmission_angle_deg.range});function posesOf({poses=[]}){let names=poses.map((pose,k)=>pose.name||
String(k+1)),short=names.every(name=>name.length<=LONGEST_NAME4);return poses.map((pose,k)=>({...pose,angle_deg:isPoint2(pose)?null:pose.angle,name:names[k],label:short?
names[k]:String(k+1)}))}var surroundingsOf=(document2,data)=>({body:Array.isArray(document2.body)?document2.body:document2.body===void 0?null:data.body});function follow(now,each2,data){
if(now.usable=each2.usable,now.led=each2.led,now.worst=each2.worst,now.least=each2.transmission_deg,now.reason=each2.reason,now.followed=!0,now.gone=null,each2.
type&&(now.type=each2.type),!each2.ways?.length){now.ways=now.ways??[];return}now.ways=each2.ways,now.pose_errors=each2.pose_errors.map(row=>({...row,at:row.way===
null?null:each2.ways[row.way],said:row.x===null?{position:"-",turned:"-",transmission:"-"}:{position:row.position<FOLLOWED*data.scene?"exact":figure(row.position),
turned:row.turned_deg<EXACT_TURN?"exact":`${figure(row.turned_deg)}°`,transmission:row.transmission_deg===null?"-":`${fixed(row.transmission_deg,1)}°`}}))}var appeared=each2=>({
id:each2.id,type:each2.type??"linkage",rank:1/0,dyads:each2.led,ways:[],pose_errors:[],isNew:!0,followed:!0,said:{met:"",story:"",facts:[],reasons:[],quality:{},
dimensions:[],notes:[],links:null,manifolds:[[],[]],worst:"–",rms:"–",transmission:"-"},space:null,shortcomings:[],defects:[],unmet:[]});function worstOf(linkage,data){
return linkage.worst===null||linkage.worst===void 0?"–":linkage.followed?linkage.worst<FOLLOWED*data.scene?"exact":`${figure(linkage.worst)}${data.unit?` ${data.
unit}`:""}`:linkage.said.worst==="-"?"–":linkage.said.worst==="exact"?"exact":`${linkage.said.worst}${data.unit?` ${data.unit}`:""}`}function pathErrorOf(linkage,data){
let{rms}=linkage.said,worst=worstOf(linkage,data);return linkage.followed||!rms||rms==="-"||rms==="exact"?worst:`${rms} rms, ${worst} at most`}function leastOf(linkage){
return linkage.followed?linkage.least===null||linkage.least===void 0?"–":`${Math.floor(10*linkage.least+1e-6)/10}°`:linkage.said.transmission==="-"?"–":linkage.
said.transmission}function dimensionsOf(linkage,data){let digits=decimalsOf(data),point2=p=>`(${p.map(value=>fixed(value,digits)).join(", ")})`;return linkage.led.
flatMap(dyad=>[...dyad.fixed_pivot?[{dyad:dyad.id,what:"fixed pivot in F",value:point2(dyad.fixed_pivot)}]:[],...dyad.moving_pivot?[{dyad:dyad.id,what:"moving p\
ivot in M",value:point2(dyad.moving_pivot)}]:[],...dyad.radius!==void 0?[{dyad:dyad.id,what:"length",value:fixed(dyad.radius,digits)}]:[],...dyad.line?[{dyad:dyad.
id,what:`line in ${dyad.kind==="PR"?"F":"M"}, normal and offset`,value:`${fixed(dyad.line.normal_deg,2)}°, ${fixed(dyad.line.offset,digits)}`}]:[]])}var placeOf=row=>({
x:row.x,y:row.y,a:radians(row.angle_deg)});var dot=(a,b)=>a[0]*b[0]+a[1]*b[1]+a[2]*b[2],scaled=(a,k)=>[a[0]*k,a[1]*k,a[2]*k],plus=(a,b)=>[a[0]+b[0],a[1]+b[1],a[2]+b[2]],cross2=(a,b)=>[a[1]*b[2]-a[2]*b[1],
a[2]*b[0]-a[0]*b[2],a[0]*b[1]-a[1]*b[0]],unit=a=>scaled(a,1/Math.hypot(...a)),times=(c,p,w)=>[0,4,8,12].map(r=>c[r]*p[0]+c[r+1]*p[1]+c[r+2]*p[2]+c[r+3]*w);function intersections(c,o,d){
let cd=times(c,d,0),co=times(c,o,1),a=dot(d,cd),b=dot(o,cd)+cd[3],e=dot(o,co)+co[3],root=b*b-a*e;if(root<0)return[];let q=-(b+(b<0?-1:1)*Math.sqrt(root)),roots=[];
return Math.abs(a)>1e-12*Math.abs(q)&&roots.push(q/a),q!==0&&roots.push(e/q),roots}function instantCentre(dyads,place){let[u,v,omega]=cross2(gradient(dyads[0],place),gradient(dyads[1],place)),centre=[place.x-v/omega,place.y+u/omega];return Number.
isFinite(centre[0])&&Number.isFinite(centre[1])?centre:null}function centrodePoint(dyads,place){let fixed2=instantCentre(dyads,place);return fixed2&&{fixed:fixed2,
moving:back(place,fixed2)}}function driveOf(dyad,place){if(dyad.kind==="PR")return alongLine(dyad,place);if(dyad.kind==="RP")return place.a+radians(dyad.line.normal_deg);
let[x,y]=act(place,dyad.moving_pivot);return Math.atan2(y-dyad.fixed_pivot[1],x-dyad.fixed_pivot[0])}function transmissionOf(driver,follower,place){if(driver.kind===
"PP"||follower.kind==="PP")return null;let slot=dyad=>{let[nx,ny]=normalOf(dyad),c=Math.cos(place.a),d=Math.sin(place.a);return[c*nx-d*ny,d*nx+c*ny]};if(driver.
kind==="RP"&&follower.kind==="RP")return 90;if(follower.kind==="RP"){let pin=act(place,driver.moving_pivot),[x,y]=follower.fixed_pivot;return between(slot(follower),
[x-pin[0],y-pin[1]])}let end=act(place,follower.moving_pivot),lever=follower.kind==="PR"?normalOf(follower):[end[0]-follower.fixed_pivot[0],end[1]-follower.fixed_pivot[1]];
if(driver.kind==="RP")return between(slot(driver),lever);let start=act(place,driver.moving_pivot);return between([end[0]-start[0],end[1]-start[1]],lever)}var between=(a,b)=>Math.
atan2(Math.abs(a[0]*b[1]-a[1]*b[0]),Math.abs(a[0]*b[0]+a[1]*b[1]))*180/Math.PI;var Labels=class{constructor(view){this.view=view,this.taken=[]}block(x,y,width,height){this.taken.push([x-width/2,y-height/2,x+width/2,y+height/2])}put(x,y,text,distance,attributes){
let width=7.2*text.length+4,height=14,best={cost:1/0,cx:0,cy:0,box:[0,0,0,0]};for(let ring=0;ring<3;ring+=1)for(let k=0;k<16;k+=1){let angle=Math.PI/8*k+Math.PI/
4,away2=distance+9*ring,cx=x+(away2+width/2-6)*Math.cos(angle),cy=y-away2*Math.sin(angle),box=[cx-width/2,cy-height/2,cx+width/2,cy+height/2],cost=.02*k+6*ring;
for(let other of this.taken){let across=Math.min(box[2],other[2])-Math.max(box[0],other[0]),down=Math.min(box[3],other[3])-Math.max(box[1],other[1]);across>0&&down>
0&&(cost+=across*down)}(box[0]<2||box[2]>this.view.width-2)&&(cost+=500),(box[1]<2||box[3]>this.view.height-2)&&(cost+=500),cost<best.cost&&(best={cost,cx,cy,box})}
return this.taken.push(best.box),s("text",{x:px(best.cx),y:px(best.cy+4),"text-anchor":"middle",...attributes},text)}};var LONGEST=4e3;function railOf(dyad,places,view){let[nx,ny]=normalOf(dyad),[low,high]=travelOf(dyad,places),half=view.scale*(high-low)/2+BLOCK[0],edge=BLOCK[1]/
2+1,[x,y]=(at=>[view.X(at[0]),view.Y(at[1])])(pointOnLine(dyad,(low+high)/2)),bodySide=places.reduce((sum,place)=>sum+nx*place.x+ny*place.y-dyad.line.offset,0),
turned=Math.atan2(nx,-ny)+(bodySide>0?Math.PI:0),drawn=Math.min(half,LONGEST),hatch="";for(let k=-drawn+4;k<drawn-2;k+=8)hatch+=`M${px(k+4)} ${edge}l-6 7`;return{
x,y,half,drawn,turned,paths:[`M${px(-half)} ${edge}H${px(half)}${hatch}`,`M${px(-half)} ${-edge}H${px(half)}`]}}var CLOSER=.4,BESIDE_PIVOT=[16,28,40],FACTORS=[0,1,10,100,1e3,1e4,1e5];function factorFor(data,linkage){let worst=Math.max(0,...linkage.pose_errors.map(row=>row.
position??0));if(!(worst>1e-9*data.scene))return 0;let fits=FACTORS.filter(factor=>factor>=1&&factor*worst<.3*data.scene);return fits.length?fits[fits.length-1]:
1}var sizeOf=([x,y,u,v])=>Math.max(u-x,v-y),standing2=(dyad,places)=>dyad.fixed_pivot??(dyad.kind==="PR"&&places.length?pointOnLine(dyad,travelOf(dyad,places).reduce(
(a,b)=>(a+b)/2)):null);var Plane=class{view;places;linkage;reveal;constructor(data,parent){this.data=data,this.svg=s("svg",{class:"bm-plane",role:"img",tabindex:"0"}),this.parent=parent,
parent.append(this.svg)}build(linkage,way,stretch,{factor,fill,far,close=!1}){let{data,svg}=this,path2=linkage?.ways[way];this.linkage=linkage,this.way=way,this.
places=path2?placesOf(data,linkage,path2,stretch):[];let width=Math.max(260,this.parent.clientWidth),box=boxOf(data,linkage,this.places,{whole:far,close}),different=other=>other.
some((each2,k)=>each2!==box[k]);this.cut=!far&&different(boxOf(data,linkage,this.places,{whole:!0})),this.isLarge=close||!!linkage&&sizeOf(boxOf(data,linkage,this.
places,{close:!0}))<CLOSER*sizeOf(box);let shape=(box[3]-box[1])/(box[2]-box[0]),own=clamp(width*clamp(shape,.45,1),260,clamp(.62*window.innerHeight,340,680)),height=Math.
round(fill?clamp(fill,own,1.15*width):own),view=viewOf(box,width,height,width<500?34:42);this.view=view,svg.setAttribute("viewBox",`0 0 ${width} ${height}`),svg.
setAttribute("height",height),svg.dataset.scale=view.scale,svg.dataset.left=view.left,svg.dataset.top=view.top,svg.replaceChildren(),svg.append(this.grid(),keepOut(
data,view),ghosts(data,linkage,view)),svg.append(...[this.wantedPath(),linkage?this.paths():null].filter(Boolean));let labels=new Labels(view);this.names=s("g",
{class:"bm-names"},keepOutNames(data,view,labels)),linkage&&svg.append(this.ground(labels));for(let pose of data.poses){let x=view.X(pose.x),y=view.Y(pose.y),angle=radians(
pose.angle_deg),c=AXIS*Math.cos(angle),d=AXIS*Math.sin(angle);if(labels.block(x,y,12,12),!isPoint(pose))for(let share of[.35,.65,1])labels.block(x+share*c,y-share*
d,6,6),labels.block(x-.6*share*d,y-.6*share*c,6,6)}svg.append(this.poses(linkage,factor,labels)),this.moving=path2?mechanism(data,linkage,view,this.places):null,
this.moving&&svg.append(this.moving.group),linkage&&this.farPivots(labels),svg.append(this.names)}grid(){let{view}=this,group=s("g",{class:"bm-grid","aria-hidde\
n":"true"}),unit2=this.data.unit?` ${this.data.unit}`:"",across=ticks(-view.left/view.scale,(view.width-view.left)/view.scale,view.width/110),up=ticks((view.top-
view.height)/view.scale,view.top/view.scale,view.height/80);for(let{at,text}of across){let x=px(view.X(at));group.append(s("path",{d:`M${x} 0V${view.height}`})),
x>46&&x<view.width-(unit2?54:30)&&group.append(s("text",{x,y:view.height-6,"text-anchor":"middle"},text))}for(let{at,text}of up){let y=px(view.Y(at));group.append(
s("path",{d:`M0 ${y}H${view.width}`})),y>26&&y<view.height-24&&group.append(s("text",{x:6,y:y-4},text))}return group.append(s("text",{x:6,y:14},`y${unit2}`),s("\
text",{x:view.width-6,y:view.height-6,"text-anchor":"end"},`x${unit2}`)),group}paths(){let{view,linkage,places}=this,group=s("g",{class:"bm-paths"});linkage.ways.
forEach((way,k)=>{let same=way.circuit===linkage.ways[this.way]?.circuit,kind=k===this.way?"bm-beyond":same?"bm-same":"bm-other",whole=placesOf(this.data,linkage,
way,{low:0,high:way.x.length-1}),d2=polyline(whole.map(({x,y})=>[x,y]),view);group.append(s("path",{class:`bm-curve ${kind}`,d:d2}))});for(let{side,points}of this.
pivotPaths())group.append(s("path",{class:`bm-pivot-path bm-side${side}`,d:polyline(points,view)}));let d=polyline(places.map(({x,y})=>[x,y]),view);return group.
append(s("path",{class:"bm-curve bm-here",d})),group}pivotPaths(){let{places,linkage}=this;return linkage.traced?[...linkage.traced].map(joint=>({side:"-inner",
points:places.map(place=>place.joints[joint])})):[...linkage.led.entries()].filter(([,dyad])=>dyad.moving_pivot&&dyad.kind!=="PR").map(([side,dyad])=>({side,points:places.
map(place=>act(place,dyad.moving_pivot))}))}ground(labels){let group=s("g",{class:"bm-grounds"});return this.keepCranksFree(labels),this.linkage.led.forEach((dyad,k)=>{
let side=Math.min(k,1);dyad.kind==="PR"?this.rail(group,labels,dyad,side):dyad.fixed_pivot&&this.fixedPivot(group,labels,dyad,side)}),group}keepCranksFree(labels){
let{view,places,linkage}=this,every=Math.ceil(places.length/9),arms=(linkage.drawn??[]).flatMap(({joints})=>[...joints].filter(joint=>joint in linkage.ground).flatMap(
pivot=>[...joints].map(end=>[pivot,end])));for(let{joints}of places.filter((_,k)=>k%every===0))for(let[pivot,end]of arms){let[[x,y],[u,v]]=[joints[pivot],joints[end]].
map(at=>[view.X(at[0]),view.Y(at[1])]),size2=Math.hypot(u-x,v-y);if(size2)for(let along2 of BESIDE_PIVOT)labels.block(x+along2*(u-x)/size2,y+along2*(v-y)/size2,
12,12)}}rail(group,labels,dyad,side){if(!this.places.length)return;let{x,y,drawn,turned,paths}=railOf(dyad,this.places,this.view),[nx,ny]=normalOf(dyad);group.append(
s("g",{class:`bm-rail bm-side${side}`,"data-dyad":dyad.id,transform:transform(x,y,turned)},s("path",{class:"bm-ground",d:paths[0]}),s("path",{class:"bm-ground b\
m-thin",d:paths[1]})));for(let k=-drawn;k<=drawn;k+=14)labels.block(x-k*ny,y-k*nx,22,22);this.names.append(labels.put(x,y,dyad.id,26,{class:`bm-name bm-side${side}`}))}fixedPivot(group,labels,dyad,side){
let x=this.view.X(dyad.fixed_pivot[0]),y=this.view.Y(dyad.fixed_pivot[1]);labels.block(x,y+10,32,34),side||labels.block(x,y,40,40);let at=foot();at.setAttribute(
"transform",`translate(${px(x)} ${px(y)})`),group.append(at),this.names.append(labels.put(x,y+4,dyad.name??dyad.id,27,{class:`bm-name bm-side${side}`}))}farPivots(labels){
let{data,view}=this,digits=decimalsOf(data);this.linkage.led.forEach((dyad,side)=>{let at=standing2(dyad,this.places),edge=at&&edgeTowards(view,at);if(!edge)return;
let text=`${dyad.name??dyad.id}: ${dyad.fixed_pivot?"fixed pivot":"rail"} at (${at.map(each2=>fixed(each2,digits)).join(", ")})`;labels.block(edge.x,edge.y,20,20),
this.names.append(s("g",{class:"bm-to-far",onclick:()=>this.reveal?.()},s("path",{class:`bm-far-mark bm-side${side}`,d:"M-9 -6L3 0L-9 6",transform:transform(edge.
x,edge.y,edge.angle)}),labels.put(edge.x,edge.y,text,14,{class:`bm-name bm-far-name bm-side${side}`})))})}wantedPath(){let{data,view}=this;if(!data.path)return null;
let points=data.poses.map(({x,y})=>[x,y]);return s("path",{class:"bm-wanted-path",d:`${polyline(points,view)}${data.path.closed?"Z":""}`})}poses(linkage,factor,labels){
let{data,view}=this,group=s("g",{class:"bm-poses"}),small=data.poses.length>24?.6:1,arrows=this.errors(linkage,factor,labels),names=s("g",{class:"bm-pose-names"});
return data.poses.forEach((pose,k)=>{let x=view.X(pose.x),y=view.Y(pose.y);group.append(s("g",{class:"bm-wanted",transform:transform(x,y,isPoint(pose)?0:radians(
pose.angle_deg)),"data-pose":k+1},isPoint(pose)?null:s("path",{d:axes(AXIS*small)}),s("circle",{r:4.5*small}))),data.poses.length<=60&&isNamed(data,k)&&names.append(
labels.put(x,y,pose.label,13,{}));let row=linkage?.pose_errors[k];if(!row||row.x===null)return;let elsewhere=row.way===this.way?"":" bm-elsewhere";group.append(
s("g",{class:`bm-achieved${elsewhere}`,transform:transform(view.X(row.x),view.Y(row.y),radians(row.angle_deg))},isPoint(pose)?null:s("path",{d:axes(.72*AXIS*small)}),
s("circle",{r:2.2*small})))}),group.append(arrows,names),group}errors(linkage,factor,labels){let{data,view}=this,arrows=s("g",{class:"bm-errors"});return!linkage||
!factor||(linkage.pose_errors.forEach((row,k)=>{if(row.x===null)return;let pose=data.poses[k],x=view.X(pose.x),y=view.Y(pose.y),dx=factor*view.scale*(row.x-pose.
x),dy=-factor*view.scale*(row.y-pose.y),size2=Math.hypot(dx,dy);if(size2<1.5)return;let head2=Math.min(7,.5*size2),ux=dx/size2,uy=dy/size2,tip=`${px(x+dx)} ${px(
y+dy)}`,barb=sign=>`L${px(x+dx-head2*(ux-sign*.5*uy))} ${px(y+dy-head2*(uy+sign*.5*ux))}`;arrows.append(s("path",{d:`M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(
-1)}`}));for(let share=0;share<=1;share+=.2)labels.block(x+share*dx,y+share*dy,8,8)}),arrows.children.length&&this.names.append(scaleOfErrors(view,factor))),arrows}show(place,drive){
this.moving?.show(place,drive)}},scaleOfErrors=({width},factor)=>s("text",{class:"bm-error-scale",x:width-8,y:16,"text-anchor":"end"},factor===1?"errors to scal\
e":`errors × ${factor.toLocaleString("en").replaceAll(","," ")}`);var hundredths=value=>Math.round(Math.min(Math.max(value,-1e6),1e6)*100)/100;function smoothPath(X,Y,closed2){let last=X.length-1;if(last<1)return"";let ahead=(values,k)=>k<
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
{linkage,path:path2}=playing,{view}=scene,there2=!!linkage&&!linkage.gone;for(let part of[this.paths,this.holder,this.labels,this.edges])put(part,"visibility",there2?
"visible":"hidden");if(!there2)return;let places=path2?framesOf(path2):[];if(this.enlarge(),this.curves(linkage,path2,places,view),this.ground(linkage,places,view),
this.outside(linkage,view),this.atPoses(linkage,view),!path2){this.mechanism?.group.remove(),this.mechanism=null;return}this.mechanism?.fits(linkage)||(this.mechanism?.
group.remove(),this.mechanism=new Mechanism(linkage),this.holder.append(this.mechanism.group)),this.mechanism.shape(answers.data,linkage,view,places)}curves(linkage,path2,places,view){
let set=(element,list2,closed2)=>put(element,"d",smoothPath(list2.map(([x])=>view.X(x)),list2.map(([,y])=>view.Y(y)),closed2)),others=linkage.ways.filter(way=>way!==
path2);if(put(this.others,"d",others.map(way=>pathOf2(way,view)).join("")),put(this.beyond,"d",path2?pathOf2(path2,view):""),this.pivotPaths.forEach((element,side)=>{
let dyad=linkage.led[side];!path2||!dyad.moving_pivot||dyad.kind==="PR"?put(element,"d",""):set(element,places.map(place=>act(place,dyad.moving_pivot)),path2.round)}),
!path2){put(this.here,"d","");return}let{low,high}=this.playing.player.stretch,{length}=this.answers.data.chart,list=[],end=u=>(place=>[place.x,place.y])(placeAt(
linkage,path2,u,length));list.push(end(low));for(let k=Math.floor(low)+1;k<high;k+=1)list.push([path2.x[k],path2.y[k]]);list.push(end(high)),set(this.here,list,
path2.round&&high-low>path2.x.length-1-1e-6)}ground(linkage,places,view){let{scene}=this;linkage.led.forEach((dyad,side)=>{let[rail,at,name]=[this.rails[side],this.
feet[side],this.names[side]],slides=dyad.kind==="PR"&&places.length>0;put(rail,"display",slides?"inline":"none"),put(at,"display",dyad.fixed_pivot?"inline":"non\
e"),put(name,"display",slides||dyad.fixed_pivot?"inline":"none"),say(name,dyad.id);let x,y;if(slides){let drawn=railOf(dyad,places,view);({x,y}=drawn),put(rail,
"transform",transform(x,y,drawn.turned)),drawn.paths.forEach((d,k)=>put(rail.children[k],"d",d)),put(rail,"data-dyad",dyad.id)}else if(dyad.fixed_pivot)[x,y]=[view.
X(dyad.fixed_pivot[0]),view.Y(dyad.fixed_pivot[1])],put(at,"transform",`translate(${px(x)} ${px(y)})`);else return;scene.names.put(name,x,y+FOOT,dyad.id,around(
dyad.id,-Math.PI/2,OFF2))})}outside(linkage,view){let marks=linkage.led.flatMap((dyad,side)=>{let edge=dyad.fixed_pivot&&edgeTowards(view,dyad.fixed_pivot),end=edge&&
edge.x>view.width/2;return edge?[s("g",{class:`bm-to-far bm-side${side}`,"data-dyad":dyad.id,onclick:()=>this.scene.reveal(dyad.fixed_pivot)},s("path",{class:`b\
m-far-mark bm-side${side}`,d:"M-9 -6L3 0L-9 6",transform:transform(edge.x,edge.y,edge.angle)}),s("text",{class:`bm-name bm-side${side}`,x:px(edge.x+(end?-12:12)),
y:px(clamp(edge.y+4,14,view.height-24)),"text-anchor":end?"end":"start"},`${dyad.id} is outside`))]:[]});this.edges.replaceChildren(...marks,...this.factor?[scaleOfErrors(
view,this.factor)]:[])}atPoses(linkage,view){let{achieved,answers:{data}}=this,rows=linkage.pose_errors,count=Math.min(rows.length,MOST_ACHIEVED),small=count>24?
.6:1;for(;achieved.children.length>count;)achieved.lastChild.remove();for(;achieved.children.length<count;)achieved.append(s("g",{class:"bm-achieved"},s("path",
{}),s("circle",{})));let arrows="";for(let k=0;k<count;k+=1){let row=rows[k],group=achieved.children[k];if(group.dataset.size!==String(small)&&(group.dataset.size=
small,put(group.children[0],"d",axes(.72*AXIS*small)),put(group.children[1],"r",2.2*small)),row.x===null){put(group,"display","none");continue}put(group,"displa\
y","inline"),put(group.children[0],"display",data.poses[k]?.angle_deg===null?"none":"inline"),put(group,"transform",transform(view.X(row.x),view.Y(row.y),radians(
row.angle_deg))),group.classList.toggle("bm-elsewhere",row.at!==this.playing.path),this.factor&&data.poses[k]&&(arrows+=arrow(view,data.poses[k],row,this.factor))}
put(this.arrows,"d",arrows)}},framesOf=way=>Array.from(way.x,(x,k)=>({x,y:way.y[k],a:way.angle[k]})),pathOf2=(way,view)=>smoothPath(Array.from(way.x,view.X),Array.
from(way.y,view.Y),way.round);function arrow(view,pose,row,factor){let x=view.X(pose.x),y=view.Y(pose.y),by=factor*view.scale,dx=by*(row.x-pose.x),dy=-by*(row.y-
pose.y),size2=Math.hypot(dx,dy);if(!(size2>=LEAST_ARROW2))return"";let head2=Math.min(7,.5*size2),ux=dx/size2,uy=dy/size2,tip=`${px(x+dx)} ${px(y+dy)}`,barb=sign=>`\
L${px(x+dx-head2*(ux-sign*.5*uy))} ${px(y+dy-head2*(uy+sign*.5*ux))}`;return`M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}`}var FARTHEST=30,JUMP=2;function centrodesOf(linkage,way,scene,near2){let before=null,points=framesOf(way).map(place=>{let point2=centrodePoint(linkage.led,place),
far=!point2||Math.hypot(point2.fixed[0]-near2[0],point2.fixed[1]-near2[1])>FARTHEST*scene,cut=far||before&&Math.hypot(point2.fixed[0]-before[0],point2.fixed[1]-
before[1])>JUMP*scene;return before=far?null:point2.fixed,{point:far?null:point2,cut}}),pieces2=key=>points.flatMap(({point:point2,cut})=>cut?[null,point2&&point2[key]]:
[point2?.[key]]);return{fixed:pieces2("fixed"),moving:pieces2("moving")}}var path=(points,X,Y)=>{let d="",pen="M";for(let point2 of points)point2&&(d+=`${pen}${px(
X(point2[0]))} ${px(Y(point2[1]))}`),pen=point2?"L":"M";return d},Centrodes=class{constructor(answers,playing,scene){this.answers=answers,this.playing=playing,this.
scene=scene,this.fixed=s("path",{class:"bs-centrode bs-fixed-centrode"}),this.moving=s("path",{class:"bs-centrode bs-moving-centrode"}),this.mark=s("g",{class:"\
bs-instant-centre"},s("circle",{r:5}),s("path",{d:"M-9 0H9M0 -9V9"})),this.rays=s("path",{class:"bs-rays"}),this.group=s("g",{class:"bs-centrodes",visibility:"h\
idden","aria-hidden":"true"},this.fixed,this.moving,this.rays,this.mark),scene.layer("curves").append(this.group),this.box=h("input",{type:"checkbox","data-tool":"\
centrodes",onchange:()=>this.shape()}),this.readout=h("output",{class:"bs-quiet"}),this.element=h("div",{class:"bs-tool"},h("label",{},this.box," Instant centre\
 and centrodes")," ",this.readout),playing.on("shape",()=>this.shape()),playing.on("place",({place})=>this.show(place)),scene.on("view",()=>this.shape())}get on(){
return this.box.checked&&!!this.playing.path&&!this.playing.linkage.gone}shape(){if(put(this.group,"visibility",this.on?"visible":"hidden"),!this.on){this.readout.
textContent="";return}let{data}=this.answers,{linkage,path:way}=this.playing,{view}=this.scene,[pose]=data.poses,both=centrodesOf(linkage,way,data.scene,pose?[pose.
x,pose.y]:[0,0]);put(this.fixed,"d",path(both.fixed,view.X,view.Y)),put(this.moving,"d",path(both.moving,x=>view.scale*x,y=>-view.scale*y)),this.playing.here&&this.
show(this.playing.here.place)}show(place){if(!this.on)return;let{view}=this.scene,{led}=this.playing.linkage,centre=instantCentre(led,place);put(this.moving,"tr\
ansform",transform(view.X(place.x),view.Y(place.y),place.a));let there2=centre&&Math.hypot(centre[0]-place.x,centre[1]-place.y)<FARTHEST*this.answers.data.scene;
put(this.mark,"visibility",there2?"inherit":"hidden"),put(this.rays,"visibility",there2?"inherit":"hidden");let digits=decimalsOf(this.answers.data),unit2=this.
answers.data.unit?` ${this.answers.data.unit}`:"";if(this.readout.textContent=centre?`at (${centre.map(value=>fixed(value,digits)).join(", ")})${unit2}`:"at inf\
inity: the body only shifts",!there2)return;let[x,y]=[view.X(centre[0]),view.Y(centre[1])];put(this.mark,"transform",`translate(${px(x)} ${px(y)})`);let ends=led.
filter(dyad=>dyad.fixed_pivot).map(dyad=>`M${px(view.X(dyad.fixed_pivot[0]))} ${px(view.Y(dyad.fixed_pivot[1]))}L${px(x)} ${px(y)}`);put(this.rays,"d",ends.join(
""))}};var CognatePanel=class{known;constructor(store,answers){this.store=store,this.answers=answers,this.known=null,this.asking=!1,this.story=h("p",{class:"bm-story"}),
this.cards=h("div",{class:"bs-cognates",role:"group","aria-label":"The linkages of one curve"}),this.element=h("div",{class:"bs-cognate-panel"},this.story,this.
cards),this.pace=new Pace(()=>this.renew(),()=>isSeen(this.element)),answers.on("answers shown placed",()=>this.pace.ask()),store.on("state document",()=>this.pace.
ask()),watch(this.element,()=>this.pace.ask())}get of(){let{placed,chosen}=this.store;return this.answers.get(chosen===PLACED?placed?.cognateOf:chosen)??(chosen===
PLACED?void 0:this.answers.shown)}async renew(){let{store,answers}=this,{of}=this;if(!isOfPoints(store.document))return;if(!of||of.gone||answers.isOld)return this.
show(of&&!of.gone?"The cognates are looked for when the answer is there.":"No linkage is there.");let key=store.solved;if(this.known?.key===key&&this.known.of===
of.id)return this.show();if(!(this.asking||!store.connection?.isOpen)){this.asking=!0;try{let answer=await store.connection.ask({do:"cognates",document:store.document,
linkage:of.id});answer.kind==="cognates"&&(this.known={key,of:of.id,linkages:answer.linkages.map(linked)})}catch{}if(this.asking=!1,this.known?.key===store.solved&&
this.known.of===this.of?.id)return this.show();store.solved!==key&&this.pace.ask()}}show(instead){let{known,of}=this,there2=!instead&&known&&of,none=there2&&!known.
linkages.length;say(this.story,instead??(none?`${of.id} has no cognates: a link of theirs would have no length.`:"By Roberts' theorem these linkages trace the s\
ame curve, with the same error. Choose one by its room, its pivots and its transmission.")),this.cards.replaceChildren(...there2&&!none?[of,...known.linkages].map(
(each2,k)=>this.card(each2,k)):[]),give(this.cards,"hidden",!there2||none),put(this.element,"data-of",there2?of.id:null)}card(linkage,k){let{store,answers:{data}}=this,
{of}=this,digits=decimalsOf(data),unit2=data.unit?` ${data.unit}`:"",point2=at=>`(${at.map(value=>fixed(value,digits)).join(", ")})`,{links}=linkage.said,chosen=k?
store.chosen===PLACED&&store.placed?.linkage?.id===linkage.id:store.chosen===of.id,facts=[["fixed pivots",linkage.led.filter(dyad=>dyad.fixed_pivot).map(dyad=>point2(
dyad.fixed_pivot)).join(" and ")],...links?[["links",`${Object.entries(links).map(([name,value])=>`${name} ${value}`).join(", ")}${unit2}`]]:[],["transmission",
leastOf(linkage)==="–"?"–":`${leastOf(linkage)} or more`],["size",linkage.said.quality.extent??"–"]];return h("article",{class:`bs-card bm-choice ${linkage.
usable?"bm-good":"bm-bad"}${chosen?" bs-chosen":""}`,"data-cognate":k},h("button",{type:"button",class:"bs-card-main","aria-pressed":String(!!chosen),onclick:()=>this.
choose(k)},h("span",{class:"bm-choice-head"},h("b",{},k?`Cognate ${k}`:of.id)," ",h("span",{class:"bm-type"},linkage.type)),h("span",{class:"bm-verdict"},linkage.
usable?"✓ usable":"✕ not usable"),h("dl",{class:"bs-figures"},facts.map(([name,value])=>[h("dt",{},name),h("dd",{},value)])),linkage.usable?null:h("span",{class:"\
bm-reason"},linkage.said.reasons.join("; "))))}choose(k){let{store,of,known}=this;k?store.takeCognate(known.linkages[k-1],of.id):store.placed?.cognateOf?store.letCognateGo():
store.choose(of.id),this.show(),this.cards.children[k]?.querySelector("button").focus()}};var LEFT2=62,RIGHT=14,TOP=22,BOTTOM=44,PANEL=84,ONLY=150,GAP=28,MANY_POSES=40,HEADROOM=1.32,NO_ERROR=1e-7,TITLE="Errors and transmission angle",INSET2=8,LONGEST_NAME5=16,
NAME_WIDTH=11,Plots=class{top=TOP;count;marks;way;width;X;stretch;across;constructor(data,parent,scrub){this.data=data,this.parent=parent,this.svg=s("svg",{class:"\
bm-plots",role:"img","aria-label":TITLE}),parent.append(this.svg);let go=event=>{if(!this.way)return;let box=this.svg.getBoundingClientRect(),at=(event.clientX-
box.left-LEFT2-INSET2)/(this.width-LEFT2-RIGHT-2*INSET2),drive=this.driveAt(this.low+clamp(at,0,1)*(this.high-this.low));drive!==null&&scrub(frameAt(this.way.drive,
drive))};this.svg.addEventListener("pointerdown",event=>{this.svg.setPointerCapture(event.pointerId),go(event)}),this.svg.addEventListener("pointermove",event=>event.
buttons&1&&go(event))}build(linkage,index,stretch){let{data,svg}=this,way=linkage.ways[index];if(this.linkage=linkage,this.way=way,svg.replaceChildren(),this.cursor=
null,!way)return;svg.setAttribute("aria-label",`${linkage.id}: ${TITLE.toLowerCase()} along the driver`);let poses=linkage.pose_errors.map((row,k)=>({...row,pose:data.
poses[k]})).filter(row=>row.way===index&&row.pose),upright=poses.some(({pose})=>pose.label!==pose.name),longest=Math.max(0,...poses.map(({pose})=>shortened(poseName(
pose),LONGEST_NAME5).length));this.top=TOP+(upright?6.2*longest+6:0);let count=linkage.panels?linkage.panels.length+1:way.loops?1:nounOf(data)==="point"?2:3,[driver]=linkage.
led,slides=driver.kind==="PR";this.stretch=stretch;let rows=poses.map(row=>({...row,drive:linear(way.drive,row.frame)})),unit2=data.unit??"unit of the poses",title=way.
told?`${way.told[0].name} (°)`:slides?`place of ${driver.id} on its line (${unit2})`:`driver angle (${driver.id})`,ends=[stretch.low,stretch.high].map(u=>linear(
way.drive,u)),[low,high]=stretch.sense<0?ends.reverse():ends;this.frame(count,low,high,!slides,title,()=>{this.panels(rows,unit2),upright&&this.uprightNames(rows)})}frame(count,low,high,turns,title,draw){
let{svg}=this,width=this.width=Math.max(260,this.parent.clientWidth);this.count=count,this.low=low,this.high=high;let base=this.top+(count>1?count*PANEL+(count-
1)*GAP:ONLY),height=base+BOTTOM;svg.setAttribute("viewBox",`0 0 ${width} ${height}`),svg.setAttribute("height",height),this.X=at=>LEFT2+INSET2+(at-low)/(high-low)*
(width-LEFT2-RIGHT-2*INSET2);let ends=[Math.min(low,high),Math.max(low,high)],marks=turns?angleTicks(ends[0],ends[1],Math.max(3,width/70)):ticks(ends[0],ends[1],
width/90);this.across=low>high?marks.reverse():marks,this.marks=[],draw(),svg.append(s("text",{class:"bm-title",x:(LEFT2+width-RIGHT)/2,y:height-6,"text-anchor":"\
middle"},title)),this.cursor=s("g",{class:"bm-cursor"},s("path",{d:`M0 ${this.top}V${base}`})),this.cursor.append(...this.marks.map(({mark})=>mark)),svg.append(
this.cursor)}heights(k){let y0=this.top+k*(PANEL+GAP);return[y0,y0+(this.count>1?PANEL:ONLY)]}placeOf(drive){return drive}driveAt(place){return place}panels(rows,unit2){
if(this.linkage.panels?.forEach((each2,k)=>this.values(k,each2)),this.linkage.panels||this.count===1){this.transmission(this.count-1,rows);return}if(this.errors(
0,`position error (${unit2})`,rows,row=>row.position,1e-11*this.data.scene),nounOf(this.data)==="point"){this.transmission(1,rows);return}this.errors(1,"angle e\
rror (°)",rows.filter(({pose})=>!isPoint(pose)),row=>row.turned_deg,1e-9),this.transmission(2,rows)}errors(k,title,rows,value,rounding){let{svg,X}=this,[y0,base]=this.
heights(k),greatest=Math.max(1e-300,...rows.map(row=>value(row)??0)),visible=greatest>rounding,high=visible?HEADROOM*greatest:1,Y=v=>base-v/high*PANEL;if(this.panel(
title,y0,base),!visible)svg.append(s("text",{class:"bm-note",x:LEFT2+8,y:y0+PANEL/2},rows.length?"exact, up to rounding":`no ${nounOf(this.data)} is on this ass\
embly`));else{for(let{at}of ticks(0,high,3).slice(1))this.rule(Y(at),figure(at));svg.append(s("text",{class:"bm-tick",x:LEFT2-6,y:base+4,"text-anchor":"end"},"0"))}
let greatestThree=new Set([...rows].sort((a,b)=>value(b)-value(a)).slice(0,3)),last=-99;for(let row of[...rows].sort((a,b)=>X(a.drive)-X(b.drive))){let x=px(X(row.
drive)),y=px(visible?Y(value(row)):base);svg.append(s("path",{class:"bm-stem",d:`M${x} ${base}V${y}`}),s("circle",{class:"bm-dot",cx:x,cy:y,r:3.5},s("title",{},
`${calledOf(row.pose)}: ${figure(value(row))}`)));let{label}=row.pose;x-last>6+6.5*label.length&&(rows.length<=MANY_POSES||greatestThree.has(row))&&(svg.append(
s("text",{class:"bm-dot-name",x,y:y-7,"text-anchor":"middle"},label)),last=x)}}transmission(k,rows){let{svg,way,width,X}=this,[y0,base]=this.heights(k),Y=v=>base-
v/90*(base-y0);this.panel("transmission angle (°)",y0,base,!0);for(let at of[0,30,60,90])this.rule(Y(at),at);let{deg:limit,said}=this.data.transmission_limit;svg.
append(s("path",{class:"bm-usual",d:`M${LEFT2} ${px(Y(limit))}H${width-RIGHT}`}));let below=limit>15&&(linear(way.transmission,this.stretch.sense<0?this.stretch.
low:this.stretch.high)??90)>limit,limitName2=s("text",{class:"bm-tick bm-halo",x:width-RIGHT-4,y:px(Y(limit))+(below?12:-4),"text-anchor":"end"},said);(way.loops??
[way.transmission]).forEach((values,loop)=>{this.mark(drive=>linear(values,frameAt(way.drive,drive)),Y);let kind=way.loops?` bm-loop${loop}`:"";this.curve(values,
Y,`bm-line${kind}`);for(let row of rows){let value=way.loops?row.loops[loop]:row.transmission_deg;value!==null&&svg.append(s("circle",{class:`bm-dot${kind}`,cx:px(
X(row.drive)),cy:px(Y(value)),r:3}))}}),svg.append(limitName2)}mark(value,Y){this.marks.push({mark:s("circle",{r:4.5}),value,Y})}values(k,curve){let{title,x,y,dots,
stems}=curve,{svg}=this,[low,high]=[Math.min(this.low,this.high),Math.max(this.low,this.high)],[y0,base]=this.heights(k),shown2=[...x.keys()].filter(i=>y[i]!==null&&
x[i]>=low&&x[i]<=high).map(i=>[x[i],y[i]]),all=[...shown2,...dots].map(([,value])=>value),least2=Math.min(...all),most=Math.max(...all),room=.08*(most-least2);if(this.
panel(title,y0,base),!(Math.max(Math.abs(least2),Math.abs(most))>NO_ERROR)){svg.append(s("text",{class:"bm-note",x:LEFT2+8,y:y0+PANEL/2},shown2.length?"exact, u\
p to rounding":"it cannot be assembled"));return}let Y=v=>base-(v-least2+room)/(most-least2+2*room)*PANEL,at=point2=>`${px(this.X(point2[0]))} ${px(Y(point2[1]))}`;
for(let{at:value,text}of ticks(least2,most,4))this.rule(Y(value),text);if(least2<0&&most>0&&svg.append(s("path",{class:"bm-usual",d:`M${LEFT2} ${px(Y(0))}H${this.
width-RIGHT}`})),stems)for(let[a,b]of shown2)svg.append(s("path",{class:"bm-stem",d:`M${at([a,0])}L${at([a,b])}`}));else svg.append(s("path",{class:"bm-line",d:`\
M${shown2.map(at).join("L")}`}));for(let[a,b]of dots)svg.append(s("circle",{class:"bm-dot",cx:px(this.X(a)),cy:px(Y(b)),r:3.5},s("title",{},`${figure(b)}°`)));
this.mark(drive=>valueAt(curve,drive),Y)}curve(values,Y,name){let{low,high}=this.stretch,frames=[low];for(let i=Math.floor(low)+1;i<high;i+=1)frames.push(i);frames.
push(high);let line2="",pen="M";for(let u of frames){let value=linear(values,u);value!==null&&(line2+=`${pen}${px(this.X(linear(this.way.drive,u)))} ${px(Y(value))}`,
pen="L")}this.svg.append(s("path",{class:name,d:line2}))}uprightNames(rows){let last=-99;for(let row of[...rows].sort((a,b)=>this.X(a.drive)-this.X(b.drive))){let x=this.
X(row.drive),y=this.top-20;if(x-last<NAME_WIDTH)continue;last=x;let text=s("text",{class:"bm-dot-name bm-upright",transform:`translate(${px(x+4)} ${px(y)}) rota\
te(-90)`});text.append(shortened(poseName(row.pose),LONGEST_NAME5)),this.svg.append(s("g",{},s("title",{},poseName(row.pose)),text))}}panel(title,y0,base,labelled3=!1){
let{svg,width}=this;svg.append(s("rect",{class:"bm-panel",x:LEFT2,y:y0,width:width-LEFT2-RIGHT,height:base-y0}),s("text",{class:"bm-title",x:LEFT2,y:y0-7},title));
let last=-99;for(let{at,text}of this.across){let x=px(this.X(at));svg.append(s("path",{class:"bm-rule",d:`M${x} ${y0}V${base}`})),labelled3&&x-last>34&&(svg.append(
s("text",{class:"bm-tick",x,y:base+15,"text-anchor":"middle"},text)),last=x)}}rule(y,text){this.svg.append(s("path",{class:"bm-rule",d:`M${LEFT2} ${px(y)}H${this.
width-RIGHT}`}),s("text",{class:"bm-tick",x:LEFT2-6,y:px(y)+4,"text-anchor":"end"},text))}show(drive){if(!this.cursor)return;let at=this.placeOf(drive);if(put(this.
cursor,"visibility",at===null?"hidden":"visible"),at!==null){this.cursor.setAttribute("transform",`translate(${px(this.X(at))} 0)`);for(let{mark,value,Y}of this.
marks){let known=value(at);put(mark,"visibility",known===null?"hidden":"inherit"),known!==null&&put(mark,"cy",px(Y(known)))}}}};var TITLE2="Loads",fieldsets=0,LoadPlots=class extends Plots{own=null;timed=null;drive;overTime=!1;constructor(data,parent,scrub){super(data,parent,scrub);let name=`\
bm-over-${fieldsets+=1}`,one=(text,overTime)=>h("label",{},h("input",{type:"radio",name,checked:!overTime,onchange:()=>this.take(overTime)}),h("span",{},text));
this.choice=h("fieldset",{class:"bm-ways bm-over",hidden:!0},one("Over the driver",!1),one("Over time",!0)),this.nothing=h("p",{class:"bm-note-text",hidden:!0},
"Loads are known from the first pose to the last, of a linkage that leads through all of them with its own driver."),this.forces=h("label",{class:"bm-forces",hidden:!0},
h("input",{type:"checkbox",class:"bm-show-forces"}),h("span",{},"Draw the forces of pins: of the link or the ground that holds a pin, on the other link; all to \
one scale")),parent.prepend(this.choice,this.forces,this.nothing)}take(overTime){this.overTime=overTime,this.draw(),this.drive!==void 0&&this.show(this.drive)}build(linkage,index){
this.svg.classList.toggle("bm-stale",!!linkage?.followed),this.linkage=linkage;let loads=linkage?.loads,here=!!loads&&loads.way===index&&!!linkage.ways[index];this.
own=here?loads:null,this.way=here?linkage.ways[index]:null,this.choice.hidden=!this.own?.timed,this.nothing.hidden=here,this.forces.hidden=!here,this.draw()}draw(){
let{svg,own,data}=this;if(svg.replaceChildren(),svg.removeAttribute("height"),this.cursor=null,!own)return;let timed=this.overTime&&own.timed?own.timed:null,panels=(timed??
own).panels,{x}=panels[0];this.timed=timed;let[driver]=this.linkage.led,slides=driver.kind==="PR",title=timed?"time (s)":slides?`place of ${driver.id} on its li\
ne (${data.unit})`:`driver angle (${driver.id})`;svg.setAttribute("aria-label",`${this.linkage.id}: ${TITLE2.toLowerCase()} over ${timed?"time":"the driver"}`);
let ends=[x[0],x[x.length-1]],[low,high]=!timed&&stretchOf(this.linkage,own.way).sense<0?ends.reverse():ends;this.frame(panels.length,low,high,!slides&&!timed,title,
()=>{panels.forEach((each2,k)=>this.lines(k,each2,k+1===panels.length))})}lines(k,{title,x,lines},last){let all=lines.flatMap(({y})=>y.filter(each2=>each2!==null)),
[y0,base]=this.heights(k),least2=Math.min(0,...all),most=Math.max(0,...all),room=.08*(most-least2||1);this.panel(title,y0,base,last);let Y=v=>base-(v-least2+room)/
(most-least2+2*room)*(base-y0);for(let{at,text}of ticks(least2,most,4))this.rule(Y(at),text);if(least2<0&&most>0&&this.svg.append(s("path",{class:"bm-usual",d:`\
M${LEFT2} ${px(Y(0))}H${this.width-RIGHT}`})),lines.forEach(({y},line2)=>{let d="",pen="M";x.forEach((at,i)=>{y[i]===null?pen="M":(d+=`${pen}${px(this.X(at))} ${px(
Y(y[i]))}`,pen="L")}),this.svg.append(s("path",{class:`bm-line bm-curve${line2}`,d})),this.mark(at=>valueAt({x,y},at),Y)}),lines.length>1){let names=s("text",{class:"\
bm-title",x:this.width-RIGHT,y:y0-7,"text-anchor":"end"});lines.forEach(({name},line2)=>names.append(s("tspan",{class:`bm-curve${line2}`,dx:line2?7:0},name))),this.
svg.append(names)}}placeOf(drive){let{own,timed}=this;if(this.linkage.followed)return null;if(timed)return valueAt(timed.time,drive);let{x}=own.panels[0];return drive<
x[0]-1e-6||drive>x[x.length-1]+1e-6?null:drive}driveAt(at){return this.timed?driveAtTime(this.timed,at):at}show(drive){this.drive=drive,super.show(drive)}};var NO_MOTION="No linkage is there whose motion could be shown.",Curves=class{constructor(answers,playing,Kind){this.playing=playing;let fill=h("div",{class:"bm\
-fill"});this.plots=new Kind(answers.data,fill,u=>playing.player.go(u)),this.nothing=h("p",{class:"bs-quiet",hidden:!0},NO_MOTION),this.element=h("div",{},this.
nothing,fill),this.pace=new Pace(()=>this.build(),()=>isSeen(fill)),playing.on("shape",()=>this.pace.ask()),playing.on("place",({drive})=>{this.isFresh&&isSeen(
fill)&&this.plots.show(drive)}),answers.on("poses",()=>this.isFresh=!1),new ResizeObserver(()=>this.pace.ask()).observe(fill),watch(fill,()=>this.pace.ask())}build(){
let{playing,plots}=this,{linkage,path:path2,player}=playing;if(give(this.nothing,"hidden",!!(linkage&&path2&&!linkage.gone)),!linkage||!path2||linkage.gone||linkage.
pose_errors.length!==plots.data.poses.length){plots.svg.replaceChildren(),plots.way=plots.cursor=null;return}plots.build(linkage,player.way,player.stretch),this.
isFresh=!0,playing.here&&plots.show(playing.here.drive)}},Charts=class extends Curves{constructor(answers,playing){super(answers,playing,Plots)}},LoadCharts=class extends Curves{constructor(answers,playing){
super(answers,playing,LoadPlots)}};var stopsOf=(linkage,index)=>linkage.pose_errors.map((row,k)=>({k,way:row.way,frame:row.frame})).filter(stop=>stop.way===index).sort((a,b)=>a.frame-b.frame);function stageOf(linkage,index,u){
let stops=stopsOf(linkage,index);if(!stops.length)return null;if(stops.length===1)return{from:stops[0].k,to:stops[0].k,share:0};let at=0;for(;at+2<stops.length&&
stops[at+1].frame<=u;)at+=1;let[a,b]=[stops[at],stops[at+1]],step=b.frame-a.frame,share=step>0?(u-a.frame)/step:0;return{from:a.k,to:b.k,share:Math.min(Math.max(
share,-1),2)}}var there=row=>!!row&&row.way!==null;function frameAtStage(linkage,stage){if(!stage)return null;let[a,b]=[stage.from,stage.to].map(k=>linkage.pose_errors[k]);
if(!there(a)||!there(b)||a.way!==b.way){let[near2,other]=stage.share<.5?[a,b]:[b,a],row=there(near2)?near2:there(other)?other:null;return row&&{way:row.way,u:row.
frame}}let way=linkage.ways[a.way],last=way.x.length-1,step=b.frame-a.frame;way.round&&Math.abs(step)>last/2&&(step-=Math.sign(step)*last);let u=a.frame+stage.share*
step;return{way:a.way,u:way.round?(u%last+last)%last:Math.min(Math.max(u,0),last)}}function comparison(one,other,data){let unit2=data.unit?` ${data.unit}`:"",both=[one,other],least2=values=>values.every(Number.isFinite)&&values[0]!==values[1]?
values[0]<values[1]?0:1:null,row=(name,text,value,sign=1)=>({name,texts:both.map(text),better:value?least2(both.map(each2=>sign*(value(each2)??NaN))):null}),links=[
"ground","driver","coupler","follower"];return[row("verdict",each2=>each2.gone?"gone":each2.usable?"usable":"not usable",each2=>each2.usable?0:1),row("type",each2=>each2.
type),row("worst miss",each2=>worstOf(each2,data),each2=>each2.worst),row("least transmission angle",each2=>leastOf(each2),each2=>each2.least,-1),row("size",each2=>each2.
quality?spans(each2.quality.extent):"–",each2=>each2.quality?.extent),row("sensitivity",each2=>each2.quality?figure(each2.quality.sensitivity):"–",each2=>each2.
quality?.sensitivity),row("driver",each2=>each2.led[0].id),...links.map(name=>row(`${name} link`,each2=>each2.said.links?.[name]?`${each2.said.links[name]}${unit2}`:
"–")),row("reason",each2=>each2.usable?"–":(each2.followed?each2.reason:each2.said.reasons.join("; "))||"–")]}var Compare=class{constructor(store,answers,playing,onstart){
this.store=store,this.onstart=onstart,this.answers=answers,this.playing=playing,this.pictures=[0,1].map(()=>h("div",{class:"bm-drawing"})),this.planes=this.pictures.
map(parent=>new Plane(answers.data,parent)),this.names=[0,1].map(()=>h("h3",{})),this.places=[0,1].map(()=>h("p",{class:"bs-quiet"})),this.table=h("div",{class:"\
bm-scroll",tabindex:0,role:"region","aria-label":"Both linkages in numbers"}),this.button=h("button",{type:"button",class:"bm-button",onclick:()=>playing.player.
play(!playing.player.playing)},"Play both"),this.close=h("button",{type:"button",class:"bs-small",onclick:()=>store.compared&&store.compare(store.compared)},"En\
d the comparison"),this.pairs=h("div",{class:"bs-beside"},[0,1].map(k=>h("div",{},this.names[k],this.pictures[k],this.places[k]))),this.empty=h("p",{class:"bm-s\
tory"},"Press “Compare” on a card: that linkage moves beside the chosen one."),this.full=h("div",{hidden:!0},this.pairs,h("div",{class:"bs-tool"},this.button,
" ",this.close),this.table),this.element=h("div",{class:"bs-compare"},this.empty,this.full),this.pace=new Pace(()=>this.build(),()=>this.on&&isSeen(this.element)),
answers.on("answers shown",()=>this.start()),playing.on("shape",()=>this.pace.ask()),playing.on("place",here=>this.show(here)),new ResizeObserver(()=>this.pace.
ask()).observe(this.element),watch(this.element,()=>this.pace.ask())}get other(){return this.answers.get(this.store.compared)}get on(){return!!(this.other&&this.
playing.linkage&&this.other!==this.answers.shown)}start(){if(give(this.full,"hidden",!this.on),give(this.empty,"hidden",this.on),!this.on)return void(this.began=
null);this.began!==this.other&&this.onstart(),this.began=this.other,this.build()}build(){if(!this.on)return;let{answers,playing,other}=this,mine=playing.linkage,
options={factor:0,fill:0,far:!1};this.names.forEach((name,k)=>name.textContent=[mine,other][k].id==="placed"?"By hand":`${[mine,other][k].id}: ${[mine,other][k].
type}`),this.planes[0].build(mine,playing.player.way,playing.player.stretch,options),this.way=null,this.buildTable(comparison(mine,other,answers.data)),playing.
here&&this.show(playing.here)}buildTable(rows){let old=this.answers.isOld?"bs-old":null;this.table.replaceChildren(h("table",{class:"bs-compared"},h("caption",{},
"Both linkages in numbers; the better one of each row is bold"),h("thead",{},h("tr",{},h("th",{scope:"col"},""),this.names.map(name=>h("th",{scope:"col"},name.textContent)))),
h("tbody",{},rows.map(({name,texts,better})=>h("tr",{class:/size|sensitivity|link/.test(name)?old:null},h("th",{scope:"row"},name),texts.map((text,k)=>h("td",{class:"\
bm-words"},better===k?h("b",{},text):text)))))))}show({place,transmission}){if(!this.on||!isSeen(this.element))return;let{playing,other,answers:{data}}=this,{player}=playing;
this.planes[0].show(place),this.tell(0,transmission);let at=frameAtStage(other,stageOf(playing.linkage,player.way,player.u));if(this.pictures[1].classList.toggle(
"bs-old",!at),!at){this.planes[1].build(other,0,{low:0,high:(other.ways[0]?.x.length??2)-1},{factor:0,fill:0,far:!1}),this.places[1].textContent="It does not re\
ach this pose.";return}if(this.way!==at.way){this.way=at.way;let stops=other.pose_errors.filter(row=>row.way===at.way).map(row=>row.frame),[low,high]=[Math.min(
...stops),Math.max(...stops)];this.planes[1].build(other,at.way,high>low?{low,high}:{low:0,high:other.ways[at.way].x.length-1},{factor:0,fill:0,far:!1})}let way=other.
ways[at.way];this.planes[1].show(placeAt(other,way,at.u,data.chart.length)),this.tell(1,way.transmission[Math.round(at.u)])}tell(k,transmission){let text=`trans\
mission angle ${transmission===null||!Number.isFinite(transmission)?"–":`${fixed(transmission,1)}°`}`;say(this.places[k],text)}};var MOST3=8,ARROWS3={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},curveOf=(way,point2)=>framesOf(way).map(place=>act(place,point2)),CouplerCurves=class{constructor(answers,playing,scene){
this.answers=answers,this.playing=playing,this.scene=scene,this.points=[],this.group=s("g",{class:"bs-coupler-curves"}),this.handles=s("g",{class:"bs-coupler-po\
ints"}),scene.layer("paths").append(this.group),scene.layer("pivots").append(this.handles),this.button=h("button",{type:"button",class:"bs-small","aria-pressed":"\
false","data-tool":"coupler-point",onclick:()=>this.pick()},"Pick a point on the body"),this.list=h("ul",{class:"bs-points"}),this.readout=h("output",{class:"bs\
-quiet"}),this.element=h("div",{class:"bs-tool"},this.button," ",this.readout,this.list),this.tool={name:"coupler-point",hint:"Click on the body: the curve of t\
hat point is drawn. Escape ends.",click:({x,y})=>this.add([x,y]),key:event=>event.key!=="Escape"?!1:(scene.use?.(null),!0),end:()=>put(this.button,"aria-pressed",
"false")},playing.on("shape",()=>this.shape()),playing.on("place",({place})=>this.show(place)),scene.on("view",()=>this.shape()),this.tell()}pick(){let on=this.
scene.tool!==this.tool;this.scene.use?.(on?this.tool:null),put(this.button,"aria-pressed",String(on))}add(at,inBody3=!1){let place=this.playing.here?.place;if(!place&&
!inBody3||this.points.length>=MOST3)return;let point2={at:inBody3?at:this.rounded(back(place,at)),path:s("path",{class:"bm-curve bs-coupler-curve"})};point2.handle=
s("g",{class:"bs-coupler-point",tabindex:0,role:"button","data-point":this.points.length+1},s("circle",{class:"bs-hold",r:13}),s("circle",{class:"bs-coupler-dot",
r:4.5})),this.drag(point2),this.points.push(point2),this.group.append(point2.path),this.handles.append(point2.handle),this.number(),this.shape()}remove(point2){
this.points=this.points.filter(each2=>each2!==point2),point2.path.remove(),point2.handle.remove(),this.number(),this.shape()}number(){this.points.forEach((point2,k)=>point2.
handle.dataset.point=k+1)}rounded(point2){return point2.map(value=>Number(value.toFixed(clamp(decimalsOf(this.answers.data),0,12))))}drag(point2){let before;this.
scene.drag?.(point2.handle,{start:()=>{before=point2.at,this.playing.player.play(!1)},move:({x,y})=>this.put(point2,back(this.playing.here.place,[x,y])),cancel:()=>this.
put(point2,before)}),point2.handle.addEventListener("keydown",event=>{let arrow2=ARROWS3[event.key];if(!(event.ctrlKey||event.metaKey)){if(arrow2){let step=(this.
scene.step??this.answers.data.scene/100)*(event.shiftKey?10:event.altKey?.1:1);this.put(point2,point2.at.map((value,k)=>value+step*arrow2[k]))}else if(event.key===
"Delete"||event.key==="Backspace")this.remove(point2);else return;event.preventDefault()}})}put(point2,at){point2.at=this.rounded(at),this.shape()}shape(){let{path:path2,
linkage}=this.playing,{view}=this.scene,there2=path2&&!linkage.gone;for(let point2 of this.points){let list=there2?curveOf(path2,point2.at):[];put(point2.path,"\
d",smoothPath(list.map(([x])=>view.X(x)),list.map(([,y])=>view.Y(y)),path2?.round)),put(point2.handle,"visibility",there2?"visible":"hidden")}there2&&this.playing.
here&&this.show(this.playing.here.place),this.tell()}show(place){let{view}=this.scene;for(let point2 of this.points){let[x,y]=act(place,point2.at);put(point2.handle,
"transform",transform(view.X(x),view.Y(y),0))}}tell(){let digits=decimalsOf(this.answers.data),key=`${this.points.map(({at})=>at.join()).join(" ")} ${digits}`;key!==
this.told&&(this.told=key,this.readout.textContent=this.points.length?"":"Its curve is drawn, and goes along with every change.",this.list.replaceChildren(...this.
points.map((point2,k)=>{let name=`Point ${k+1} at (${point2.at.map(value=>fixed(value,digits)).join(", ")}) of the body`;return put(point2.handle,"aria-label",`${name}\
. Drag it, or use the arrow keys; Delete removes it.`),h("li",{},name," ",h("button",{type:"button",class:"bs-small","aria-label":`Remove point ${k+1}`,onclick:()=>this.
remove(point2)},"Remove"))})))}};var OFF3=15,TICK=4,LEAST3=26,away=([a,b],[c,d])=>Math.hypot(c-a,d-b),Dimensions=class{isOn=!1;constructor(store,scene,playing,answers){this.store=store,this.scene=
scene,this.playing=playing,this.answers=answers,this.element=button("Dimensions",()=>{this.isOn=!this.isOn,put(this.element,"aria-pressed",this.isOn),this.draw()},
{"data-do":"dimensions","aria-pressed":"false",title:"The lengths of the chosen linkage; click one to change it"}),this.kept=new Kept(s("g",{class:"bs-dimension\
s"}),(key,item)=>this.make(item),(group,item)=>this.show(group,item)),scene.layer("labels").append(this.kept.group);for(let each2 of["shape","place"])playing.on(
each2,()=>this.draw());scene.on("view",()=>this.draw()),store.on("document solved followed chosen",()=>this.draw())}links(){let{playing:{here,linkage}}=this,place=here?.
place;if(!this.isOn||!place||!linkage||linkage.gone)return[];let ends=linkage.led.map(dyad=>({dyad,fixed:dyad.fixed_pivot,moving:dyad.moving_pivot&&act(place,dyad.
moving_pivot)})),[one,other]=ends;return[["ground",one.fixed,other.fixed,!1],["coupler",one.moving,other.moving,!1],...ends.map(({dyad,fixed:from,moving})=>[dyad.
id,from,moving,!0])].filter(([,from,to])=>from&&to).map(([name,from,to,isDyad])=>({name,from,to,isDyad}))}draw(){this.kept.draw(this.links().map(link=>[link.name,
link]))}make({name,isDyad}){let text=s("text",{class:"bs-dimension","text-anchor":"middle","dominant-baseline":"middle",...isDyad?{tabindex:0,role:"button"}:{}}),
group=s("g",{"data-dimension":name},s("path",{class:"bs-dimension-line"}),text),open=()=>this.open(name);return isDyad&&(this.scene.drag(text,{start:()=>!1,move:()=>{},
click:open}),text.addEventListener("keydown",event=>event.key==="Enter"&&(event.preventDefault(),open()))),group}show(group,{name,from,to}){let{view}=this.scene,
[line2,text]=group.children,[a,b,c,d]=[view.X(from[0]),view.Y(from[1]),view.X(to[0]),view.Y(to[1])],size2=away([a,b],[c,d]),[u,v]=[(c-a)/size2,(d-b)/size2],[x,y]=[
-v*OFF3,u*OFF3];put(group,"visibility",size2<LEAST3?"hidden":"visible");let end=(X,Y)=>`M${px(X)} ${px(Y)}l${px(x*1.3)} ${px(y*1.3)}M${px(X+x-TICK*(u+v))} ${px(
Y+y+TICK*(u-v))}l${px(2*TICK*(u+v))} ${px(2*TICK*(v-u))}`;put(line2,"d",`${end(a,b)}${end(c,d)}M${px(a+x)} ${px(b+y)}L${px(c+x)} ${px(d+y)}`);let turn=Math.atan2(
d-b,c-a)*180/Math.PI,upright=Math.abs(turn)>90?turn+180:turn;put(text,"transform",`translate(${px((a+c)/2+1.7*x)} ${px((b+d)/2+1.7*y)}) rotate(${px(upright)})`),
say(text,fixed(away(from,to),decimalsOf(this.answers.data))),text.tabIndex===0&&put(text,"aria-label",`Length of the link of ${name}: ${text.textContent}. Enter\
 changes it.`)}open(name){let link=()=>this.links().find(each2=>each2.name===name),middle2=({from,to})=>[(from[0]+to[0])/2,(from[1]+to[1])/2];this.scene.field.open(
{name:`the link of ${name}`,kind:this.store.selection?.kind,fields:[["length","length","length"]],options:{above:0},at:()=>link()&&middle2(link()),values:()=>({
length:Number(fixed(away(link().from,link().to),decimalsOf(this.answers.data)))}),set:({length})=>this.limit(name,length)});let[{input}]=this.scene.field.fields;
input.focus(),input.select()}limit(name,length){let{store,answers}=this,table3=limitedDyads(store.document,currentLinkage(store),answers.data.scene).findIndex(({
id})=>id===name);store.edit(document2=>setLimit(splitLimits(document2,!0),table3,{length:{least:length,most:length}}))}};function wayStory(way,poses){let noun=nounOf({poses}),names=poses.map(pose=>pose.label),here=way.poses.length===names.length?`all ${noun}s`:way.poses.length?`${noun}${way.
poses.length>1?"s":""} ${runs(way.poses,names)}`:`no ${noun}`,dead=way.dead.filter(Boolean).length,ends=way.round?"turns round":dead===2?"between two dead point\
s":dead?"up to a dead point":"open";return`${here}; ${ends}`}var factsOf=({said})=>h("dl",{class:"bm-facts"},said.facts.map(([name,value])=>h("div",{},h("dt",{},
name),h("dd",{},value))));function spaceStory(data,linkage){let some2=data.poses.some(isPoint),every=nounOf(data)==="point",taken=some2&&linkage?`the places tha\
t ${linkage.id} takes at ${every?"the":"its"} points`:"",marked=[every?"":"the poses",taken].filter(Boolean).join(" and "),plain=`Every place of the body is one\
 point of this space${marked?`; numbered points are ${marked}`:""}.`;if(!linkage)return[plain];let surface=side=>h("b",{class:`bm-side${side}`},linkage.led[side].
id);return[plain," The surfaces are all places that dyad ",surface(0)," (driver) and dyad ",surface(1)," (follower) allow; where they meet, the line, the couple\
r moves."]}function table2(caption,heads,rows){return h("div",{class:"bm-scroll",tabindex:0,role:"region","aria-label":caption},h("table",{},h("caption",{},caption),h("the\
ad",{},h("tr",{},heads.map(head2=>h("th",{scope:"col"},head2)))),h("tbody",{},rows.map(row=>h("tr",{},row.map((text,k)=>k?h("td",{},text):h("th",{scope:"row"},text)))))))}
var point=(at,digits)=>`(${at.map(value=>fixed(value,digits)).join(", ")})`;function poseFacts(linkage,data,points){let digits=decimalsOf(data);return linkage.pose_errors.
map((row,k)=>{let name=data.poses[k]?poseName(data.poses[k]):String(k+1);if(row.x===null)return[name,"–",...points.map(()=>"–")];let place=placeOf(row),centre=instantCentre(
linkage.led,place);return[name,centre?point(centre,digits):"at infinity",...points.map(each2=>point(act(place,each2.at),digits))]})}var FactsTable=class{constructor(store,answers,playing,curves){
this.store=store,this.answers=answers,this.playing=playing,this.curves=curves,this.element=h("div",{class:"bs-facts"}),this.pace=new Pace(()=>this.build(),()=>isSeen(
this.element)),playing.on("shape",()=>this.pace.ask()),answers.on("answers poses placed",()=>this.pace.ask()),watch(this.element,()=>this.pace.ask()),this.element.
append(h("p",{class:"bm-story"},"Nothing is known yet."))}build(){let{answers,playing}=this,{data,isOld}=answers,{linkage}=playing,parts=[],part=(title,old,...content)=>parts.
push(h("section",{class:old?"bs-old":null,"aria-label":title},h("h3",{},title),old?h("p",{class:"bs-quiet"},"As of the last whole answer."):null,content)),fits=linkage&&
linkage.pose_errors.length===data.poses.length;if(linkage){let name=linkage.id===PLACED?"Pivots put down by hand":`${linkage.id}: ${linkage.type}`,live=linkage.
followed||playing.isOther;part(name,!1,live?this.followedFacts(linkage):[h("p",{class:"bm-story"},linkage.said.story),dimensionTable(data,{...linkage,id:linkage.
id===PLACED?"the linkage by hand":linkage.id}),factsOf(linkage)])}if(part("Pose by pose",!1,poseTable(data,fits?linkage:void 0)),fits){let points=this.curves?.points??
[];part("Instant centre and picked points",!1,table2("At each pose, in F",["pose","instant centre",...points.map((each2,k)=>`point ${k+1}`)],poseFacts(linkage,data,
points)))}this.store.placed&&part("Pivots put down by hand",!1,this.placedTable()),data.linkages.length&&part("All linkages",isOld,this.linkages()),data.dyads.length&&
part("Dyads",isOld,dyadTable(data)),linkage&&!linkage.followed&&linkage.said.manifolds?.[0].length&&!playing.isOther&&part("Image space",isOld,imageTables(data,
linkage)),this.element.replaceChildren(...parts)}followedFacts(linkage){let{data}=this.answers;return[table2(`Dimensions of ${linkage.id}${inUnit(data)}`,["","",
"value"],dimensionsOf(linkage,data).map(({dyad,what,value})=>[dyad,what,value])),table2("Verdict",["","value"],[["verdict",linkage.gone??(linkage.usable?"usable":
`not usable: ${linkage.reason??linkage.said.reasons.join("; ")}`)],["worst miss",worstOf(linkage,data)],["least transmission angle",leastOf(linkage)],["driver",
linkage.led[0].id]])]}linkages(){let{answers}=this,{data}=answers;return answers.linkages.some(each2=>each2.followed)?table2("All linkages, followed",["","verdi\
ct","type","worst miss","least transmission"],answers.linkages.map(each2=>[each2.id,each2.gone?"gone":each2.usable?"usable":"not usable",each2.type,worstOf(each2,
data),leastOf(each2)])):worded(data,{...data.table,class:"bm-linkages bm-stacks"})}placedTable(){let{placed}=this.store,unit2=inUnit(this.answers.data);return table2(
`Their dyads${unit2}`,["","on the ground (F)","on the body (M)","length","rms miss","worst miss"],placed.dyads.map(dyad=>[dyad.id,dyad.said.ground,dyad.said.body,
dyad.said.length,dyad.said.rms,dyad.said.worst]))}};var FamilyPairs=class{constructor(data){this.data=data,this.map=data.family_map,this.isCurve=this.map.kind==="curve",this.columns=this.isCurve?this.map.fixed.length:
this.map.columns,this.rows=this.isCurve?this.columns:this.map.rows,this.starts=[],(this.map.loops??[]).reduce((start,size2)=>(this.starts.push(start),start+size2),
0)}letter(loop){return this.starts.length>1?`${"ABCDEFGH"[loop]} `:""}pair([i,j]){let{cells:cells2}=this.map;if(!this.isCurve)return this.decoded(cells2[j*this.
columns+i]);if(i===j)return{kind:6,driver:0,degrees:0};let[a,b]=[Math.min(i,j),Math.max(i,j)],n=this.columns,pair=this.decoded(cells2[a*n-a*(a+1)/2+b-a-1]);return i<
j?pair:{...pair,driver:1-pair.driver}}decoded(code){let rest=Math.floor(code/7);return{kind:code%7,driver:rest%2,degrees:Math.floor(rest/2)}}bestPartner(i){let best={
kind:6,degrees:0};for(let j=0;j<this.columns;j+=1){let pair=this.pair([i,j]);(pair.kind<best.kind||pair.kind===best.kind&&pair.degrees>best.degrees)&&(best=pair)}
return best}placeName(k){let loop=this.starts.findLastIndex(start=>start<=k),size2=this.map.loops[loop];return`${this.letter(loop)}${((k-this.starts[loop]+.5)/size2).
toFixed(2)}`}cellOf(pivot){if(!pivot)return null;let{low,high}=this.map,many=[this.columns,this.rows],at=pivot.map((v,k)=>Math.round((v-low[k])/(high[k]-low[k])*
(many[k]-1)));return at.every((v,k)=>v>=0&&v<many[k])?at:null}pivotOf(cell){let{low,high}=this.map,many=[this.columns,this.rows];return cell.map((v,k)=>low[k]+v/
(many[k]-1)*(high[k]-low[k]))}dyadsOf(cell){let{map}=this;return this.isCurve?cell.map(k=>({fixed:map.fixed[k],moving:map.moving[k],length:map.length[k]})):[map.
chosen,dyadOfThree(this.data.poses,this.pivotOf(cell))]}pinsOf(cell){return cell?this.dyadsOf(cell).flatMap(each2=>[...each2.fixed?[each2.fixed]:[],...each2.moving?
[this.seen(each2.moving)]:[]]):[]}seen([x,y]){let[pose]=this.data.poses,turn=pose.angle_deg*Math.PI/180,[cos,sin]=[Math.cos(turn),Math.sin(turn)];return[pose.x+
cos*x-sin*y,pose.y+sin*x+cos*y]}};function dyadOfThree(poses,pivot){let[a,b,c]=poses.map(pose=>{let turn=-pose.angle_deg*Math.PI/180,[x,y]=[pivot[0]-pose.x,pivot[1]-
pose.y];return[Math.cos(turn)*x-Math.sin(turn)*y,Math.sin(turn)*x+Math.cos(turn)*y]}),u=[b[0]-a[0],b[1]-a[1]],v=[c[0]-a[0],c[1]-a[1]],cross3=2*(u[0]*v[1]-u[1]*v[0]),
uu=u[0]**2+u[1]**2,vv=v[0]**2+v[1]**2,arm=[(uu*v[1]-vv*u[1])/cross3,(vv*u[0]-uu*v[0])/cross3];return{fixed:pivot,moving:[a[0]+arm[0],a[1]+arm[1]],length:Math.hypot(
...arm)}}var NEWTON_STEPS=6,FARTHEST_STEP=.1;function nearestOnCurve(points,loops,wanted,widest){let best=null,start=0;for(let size2 of loops){for(let i=0;i<size2;i+=1){
let j=(i+1)%size2,a=points[start+i],b=points[start+j],d=[b[0]-a[0],b[1]-a[1]],squared=d[0]*d[0]+d[1]*d[1];if(squared>widest*widest)continue;let t=squared>0?Math.
min(1,Math.max(0,((wanted[0]-a[0])*d[0]+(wanted[1]-a[1])*d[1])/squared)):0,at=[a[0]+t*d[0],a[1]+t*d[1]],away2=Math.hypot(at[0]-wanted[0],at[1]-wanted[1]);(!best||
away2<best.away)&&(best={k:start+i,next:start+j,share:t,at,away:away2})}start+=size2}return best}function circleDeterminant([o,...others]){let[a,b,c]=others.map(
([x,y])=>[x-o[0],y-o[1]]).map(([x,y])=>[x,y,x*x+y*y]);return a[2]*(b[0]*c[1]-b[1]*c[0])-b[2]*(a[0]*c[1]-a[1]*c[0])+c[2]*(a[0]*b[1]-a[1]*b[0])}function ontoCurve(poses,plane,point2,scene){
let places=poses.map(pose=>({x:pose.x,y:pose.y,a:radians(pose.angle_deg)})),value=at2=>circleDeterminant(places.map(place=>plane==="F"?back(place,at2):act(place,
at2))),step=1e-6*scene,at=point2;for(let k=0;k<NEWTON_STEPS;k+=1){let slope=[0,1].map(axis=>{let[up,down]=[1,-1].map(sense=>value(at.map((each2,n)=>each2+(n===axis?
sense*step:0))));return(up-down)/(2*step)}),squared=slope[0]**2+slope[1]**2,here=value(at);if(!(squared>0))return at;at=at.map((each2,n)=>each2-here*slope[n]/squared)}
return Math.hypot(at[0]-point2[0],at[1]-point2[1])<FARTHEST_STEP*scene?at:point2}var worthOf=pairs=>Array.from({length:pairs.columns},(_,k)=>worth(pairs.bestPartner(
k).kind)),worth=kind=>kind<2?"works":kind===2?"outside":"fails";function curvesOf({loops}){let curves={fixed:[],moving:[],loops:[],worth:[]};for(let loop of loops){
let kept2=loop.fixed.map((_,k)=>k).filter(k=>[...loop.fixed[k],...loop.moving[k]].every(Number.isFinite));curves.loops.push(kept2.length);for(let k of kept2)curves.
fixed.push(loop.fixed[k]),curves.moving.push(loop.moving[k]),curves.worth.push(loop.class?worth(loop.class[k]):"plain")}return curves}function curvePaths(points,loops,worth2,X,Y,widest){
let paths={works:"",outside:"",fails:"",plain:""},near2=(p,q)=>Math.hypot(p[0]-q[0],p[1]-q[1])<=widest,text=([x,y])=>`${Math.round(X(x)*100)/100} ${Math.round(Y(
y)*100)/100}`,between2=(p,q)=>[(p[0]+q[0])/2,(p[1]+q[1])/2],start=0;for(let size2 of loops){for(let i=0;i<size2;i+=1){let[a,b,c]=[-1,0,1].map(step=>points[start+
(i+step+size2)%size2]),list=[...near2(a,b)?[between2(a,b)]:[],b,...near2(b,c)?[between2(b,c)]:[]];list.length>1&&(paths[worth2[start+i]]+=`M${list.map(text).join(
"L")}`)}start+=size2}return paths}var LONGEST_STEP2=.5,STROKES=["plain","fails","outside","works"],FamilyCurves=class{constructor(store,answers,playing,scene){this.store=store,this.answers=answers,
this.playing=playing,this.scene=scene,this.known=null,this.live=null,this.asking=!1,this.curves=["F","M"].map(plane=>s("g",{class:`bs-curve bs-curve-${plane}`},
STROKES.map(name=>s("path",{class:`bs-curve-${name}`})))),this.group=s("g",{class:"bs-burmester",visibility:"hidden","aria-hidden":"true"},this.curves),scene.layer(
"curves").append(this.group),this.box=h("input",{type:"checkbox",checked:!0,"data-tool":"burmester-curves",onchange:()=>this.draw()}),this.label=h("label",{hidden:!0},
this.box," Burmester curves of the four poses, in the drawing"),this.legend=h("p",{class:"bm-legend",hidden:!0},h("span",{class:"bs-key-works"})," works with a \
partner; ",h("span",{class:"bs-key-outside"})," works outside limits or standard; ",h("span",{class:"bs-key-fails"})," no partner works. Solid: centre points in\
 F; dashed: circle points in M, where the body is now."),answers.on("poses",()=>answers.data.poses.length===4?this.ask():this.draw()),playing.on("place",()=>this.
move()),scene.on("view",()=>this.draw())}get family(){let{data,isOld}=this.answers;return data.poses.length!==4?null:this.live&&(isOld||!this.known)?this.live:this.
known}renew(){let{data}=this.answers,map=data.family_map;this.known=map?.kind==="curve"?{...map,worth:worthOf(new FamilyPairs(data))}:null,this.live=null,this.known||
this.ask(),give(this.label,"hidden",data.poses.length!==4),this.draw()}async ask(){let{store,answers}=this,{document:document2,options}=store;if(!(document2.poses.
length!==4||!this.box.checked||this.asking||!store.connection?.isOpen)){this.asking=!0;try{let answer=await store.connection.ask({do:"curve",document:document2,
options,judged:store.state!=="dragging"});answer.kind==="curve"&&store.document.poses.length===4&&(this.live=curvesOf(answer),this.draw())}catch{}this.asking=!1,
store.document!==document2&&answers.isOld&&this.ask()}}get widest(){return LONGEST_STEP2*this.answers.data.scene}onto(plane,point2){let map=this.family,{poses,scene}=this.
answers.data;if(!map||!this.box.checked)return null;let near2=nearestOnCurve(plane==="F"?map.fixed:map.moving,map.loops,point2,this.widest);return near2?ontoCurve(
poses,plane,near2.at,scene):point2}draw(){let map=this.family,on=!!map&&this.box.checked;if(put(this.group,"visibility",on?"visible":"hidden"),give(this.legend,
"hidden",!on),!on)return;let{view}=this.scene;[[map.fixed,view.X,view.Y],[map.moving,x=>view.scale*x,y=>-view.scale*y]].forEach(([points,X,Y],n)=>{let paths=curvePaths(
points,map.loops,map.worth,X,Y,this.widest);[...this.curves[n].children].forEach((path2,k)=>put(path2,"d",paths[STROKES[k]]))}),this.move()}move(){let{view}=this.
scene,place=this.playing.here?.place;place&&this.family&&put(this.curves[1],"transform",transform(view.X(place.x),view.Y(place.y),place.a))}};var MAX_BANDS=12,PivotMap=class{view;constructor(data,parent){this.data=data,this.parent=parent,this.canvas=h("canvas",{"aria-hidden":"true"});let name=`bm-map-${Math.
random().toString(36).slice(2)}`;this.svg=s("svg",{class:"bm-map-picture",role:"application",tabindex:"0","aria-roledescription":"map","aria-describedby":name,"\
aria-label":"Pivot map: the error of the best link for every fixed pivot. Arrow keys move a cursor, with Shift by ten steps; the error there is told."}),this.readout=
h("output",{class:"bm-readout",id:name}),this.cursor=null,this.legend=h("p",{class:"bm-legend"}),parent.append(h("div",{class:"bm-map"},this.canvas,this.svg),this.
legend,this.readout),this.svg.addEventListener("pointermove",event=>this.read(event)),this.svg.addEventListener("pointerleave",()=>this.tell()),this.svg.addEventListener(
"keydown",event=>this.move(event));let{log10_rms:levels}=data.pivot_map,known=levels.filter(level=>level!==null).sort((a,b)=>a-b),low=known[Math.floor(.002*known.
length)],high=known[Math.floor(.98*known.length)];this.step=[1/24,1/12,1/6,1/3,1/2,1,2].find(step=>(high-low)/step<MAX_BANDS-1)??3,this.low=Math.floor(low/this.
step)*this.step,this.high=Math.ceil(high/this.step)*this.step,this.count=Math.max(1,Math.round((this.high-this.low)/this.step)),this.invitation="Point at the ma\
p to read it, or move over it by arrow keys.",this.readout.append(this.invitation)}level(u,v){let{columns,rows,log10_rms:levels}=this.data.pivot_map,i=clamp(Math.
floor(u),0,columns-2),j=clamp(Math.floor(v),0,rows-2),a=u-i,b=v-j,at=j*columns+i,[p,q,r,t]=[levels[at],levels[at+1],levels[at+columns],levels[at+columns+1]],shares=[
(1-a)*(1-b),a*(1-b),(1-a)*b,a*b];return[p,q,r,t].some((level,k)=>level===null&&shares[k]>0)?null:shares[0]*p+shares[1]*q+shares[2]*r+shares[3]*t}build(linkage){
let{svg}=this,map=this.data.pivot_map,width=Math.max(240,this.parent.clientWidth),height=Math.round(width*(map.high[1]-map.low[1])/(map.high[0]-map.low[0]));this.
paint(width,height),svg.setAttribute("viewBox",`0 0 ${width} ${height}`),svg.replaceChildren();let scale=width/(map.high[0]-map.low[0]),view={width,height,X:x=>(x-
map.low[0])*scale,Y:y=>height-(y-map.low[1])*scale};this.linkage=linkage,this.view=view,this.explain(this.pivots(linkage,view)),this.mark=s("path",{class:"bm-ma\
p-cursor",d:"M-11 0H-4M4 0H11M0 -11V-4M0 4V11"}),svg.append(this.mark),this.tell()}paint(width,height){let{canvas}=this,map=this.data.pivot_map,dense=Math.min(2,
window.devicePixelRatio||1),style=getComputedStyle(this.parent),near2=rgb(style.getPropertyValue("--bm-map-near")),far=rgb(style.getPropertyValue("--bm-map-far")),
w=Math.round(width*dense),t=Math.round(height*dense);if(canvas.width===w&&this.paintedIn===near2.join())return;this.paintedIn=near2.join(),canvas.width=w,canvas.
height=t;let context=canvas.getContext("2d"),image=context.createImageData(w,t),band=new Int16Array(w*t);for(let j=0;j<t;j+=1)for(let i=0;i<w;i+=1){let level=this.
level(i/(w-1)*(map.columns-1),(1-j/(t-1))*(map.rows-1));band[j*w+i]=level===null?-1:clamp(Math.floor((level-this.low)/this.step),0,this.count-1)}for(let k=0;k<w*
t;k+=1){let own=band[k],edge=k%w&&band[k-1]!==own||k>=w&&band[k-w]!==own,share=own<0?1:own/Math.max(1,this.count-1),shade=edge?.84:1;for(let c=0;c<3;c+=1)image.
data[4*k+c]=shade*(near2[c]+share*(far[c]-near2[c]));image.data[4*k+3]=255}context.putImageData(image,0,0)}pivots(linkage,view){let{data,svg}=this,map=data.pivot_map,
labels=new Labels(view);for(let pose of data.poses){let x=px(view.X(pose.x)),y=px(view.Y(pose.y));svg.append(s("path",{class:"bm-cross",d:`M${x-3} ${y}h6M${x} ${y-
3}v6`}))}let every=new Map;for(let each2 of data.linkages)for(let dyad of each2.led)dyad.fixed_pivot&&every.set(dyad.fixed_pivot.join(),dyad);for(let dyad of data.
dyads)dyad.fixed_pivot&&every.set(dyad.fixed_pivot.join(),dyad);let inside2=([x,y])=>x>=map.low[0]&&x<=map.high[0]&&y>=map.low[1]&&y<=map.high[1];for(let dyad of every.
values()){if(!inside2(dyad.fixed_pivot))continue;let[x,y]=[view.X(dyad.fixed_pivot[0]),view.Y(dyad.fixed_pivot[1])];svg.append(s("circle",{class:"bm-some-pivot",
cx:px(x),cy:px(y),r:2.5}))}let outside=[];return(linkage?.led??[]).forEach((dyad,side)=>{if(!dyad.fixed_pivot)return;if(!inside2(dyad.fixed_pivot)){outside.push(
`the fixed pivot of ${dyad.id} lies outside`);return}let[x,y]=[view.X(dyad.fixed_pivot[0]),view.Y(dyad.fixed_pivot[1])];labels.block(x,y,12,12),svg.append(s("ci\
rcle",{class:`bm-its-pivot bm-side${side}`,cx:px(x),cy:px(y),r:6}),labels.put(x,y,dyad.id,16,{class:"bm-map-name"}))}),outside}explain(outside){let unit2=this.data.
unit?` ${this.data.unit}`:"";this.legend.replaceChildren(h("span",{class:"bm-swatch bm-near"}),` ${figure(10**this.low)}${unit2} or less`,h("span",{class:"bm-sw\
atch bm-far"}),` ${figure(10**this.high)}${unit2} or more; each line is a factor of ${figure(10**this.step)}. `,"Small dots: fixed pivots of all dyads; crosses:\
 the poses.",outside.length?` Of this linkage, ${listed(outside)}.`:"")}placeAt([u,v]){let{low,high,columns,rows}=this.data.pivot_map;return[low[0]+u/(columns-1)*
(high[0]-low[0]),low[1]+v/(rows-1)*(high[1]-low[1])]}move(event){let step={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowDown:[0,-1],ArrowUp:[0,1]}[event.key];if(!step||
event.ctrlKey||event.metaKey||event.altKey)return;event.preventDefault();let{low,high,columns,rows}=this.data.pivot_map,many=event.shiftKey?10:1,pivot=this.linkage?.
led.map(dyad=>dyad.fixed_pivot).find(Boolean)??this.placeAt([(columns-1)/2,(rows-1)/2]),[u,v]=this.cursor??[Math.round((pivot[0]-low[0])/(high[0]-low[0])*(columns-
1)),Math.round((pivot[1]-low[1])/(high[1]-low[1])*(rows-1))];this.cursor=[clamp(u+many*step[0],0,columns-1),clamp(v+many*step[1],0,rows-1)],this.tell()}tell(){let{
cursor,mark,view}=this;if(mark?.setAttribute("visibility",cursor?"visible":"hidden"),!cursor){this.readout.textContent=this.invitation;return}let[x,y]=this.placeAt(
cursor);mark?.setAttribute("transform",`translate(${px(view.X(x))} ${px(view.Y(y))})`),this.say(cursor)}read(event){let box=this.svg.getBoundingClientRect(),{columns,
rows}=this.data.pivot_map;this.say([(event.clientX-box.left)/box.width*(columns-1),(1-(event.clientY-box.top)/box.height)*(rows-1)])}say(at){let[x,y]=this.placeAt(
at),level=this.level(...at),digits=Math.max(0,2-Math.floor(Math.log10(this.data.scene))),unit2=this.data.unit?` ${this.data.unit}`:"";this.readout.textContent=`\
Fixed pivot (${fixed(x,digits)}, ${fixed(y,digits)}): the best link misses by `+(level===null?"an unknown error.":`${figure(10**level)}${unit2} (rms).`)}};var GRASP=26,STILL=3,PivotMapPanel=class{map;constructor(answers,playing,hand){this.answers=answers,this.playing=playing,this.hand=hand,this.map=null,this.handles=
null,this.element=h("div",{class:"bm-fill"}),this.pace=new Pace(()=>this.build(),()=>isSeen(this.element)),playing.on("shape",()=>this.pace.ask()),new ResizeObserver(
()=>this.pace.ask()).observe(this.element),watch(this.element,()=>this.pace.ask())}renew(){let{data}=this.answers;this.shown!==data.pivot_map&&(this.shown=data.
pivot_map,this.element.replaceChildren(),this.map=data.pivot_map?new PivotMap(data,this.element):null,this.map&&this.listen(),this.pace.ask())}build(){this.map&&
(this.map.build(this.answers.shown),this.handles=[0,1].map(k=>s("g",{class:`bs-pivot bs-map-pivot bm-side${k}`},s("circle",{class:"bs-pivot-ring",r:8}))),this.map.
svg.append(...this.handles),this.drawHandles())}drawHandles(){if(!this.handles||!this.map?.view)return;let{view}=this.map;this.handles.forEach((element,k)=>{let pivot=this.
hand.pivot(k,"F");put(element,"display",pivot?"inline":"none"),pivot&&(put(element,"transform",`translate(${px(view.X(pivot.at[0]))} ${px(view.Y(pivot.at[1]))})`),
element.dataset.mapPivot=pivot.id)})}nearest([x,y]){let{view}=this.map,away2=[0,1].map(k2=>{let pivot=this.hand.pivot(k2,"F");return pivot?Math.hypot(view.X(pivot.
at[0])-view.X(x),view.Y(pivot.at[1])-view.Y(y)):1/0}),k=away2[1]<away2[0]?1:0;return{k,away:away2[k]}}listen(){let{hand}=this,{svg}=this.map,at=event=>{let box=svg.
getBoundingClientRect(),{low,high}=this.answers.data.pivot_map,u=(event.clientX-box.left)/box.width,v=1-(event.clientY-box.top)/box.height;return[low[0]+u*(high[0]-
low[0]),low[1]+v*(high[1]-low[1])]},pointer=null,start=null,end=event=>{event.pointerId===pointer&&(pointer=null,hand.drop())};svg.addEventListener("pointerdown",
event=>{if(event.button!==0)return;let point2=at(event),{k,away:away2}=this.nearest(point2);!Number.isFinite(away2)||!hand.take(k,"F")||(event.preventDefault(),
pointer=event.pointerId,start={near:away2<=GRASP,X:event.clientX,Y:event.clientY},svg.setPointerCapture(pointer),this.playing.player.play(!1),start.near||hand.put(
point2))}),svg.addEventListener("pointermove",event=>{event.pointerId===pointer&&(start.near&&Math.hypot(event.clientX-start.X,event.clientY-start.Y)<STILL||(start.
near=!1,hand.put(at(event))))}),svg.addEventListener("pointerup",end),svg.addEventListener("pointercancel",end),svg.addEventListener("keydown",event=>{if(event.
key==="Escape"&&hand.pivots&&hand.release(),event.key!=="Enter"||!this.map.cursor)return;let point2=this.map.placeAt(this.map.cursor),{k}=this.nearest(point2);hand.
take(k,"F")&&(event.preventDefault(),hand.put(point2),hand.drop())})}};var ARROWS4={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},PivotSurface=class{held;constructor(store,answers,playing,scene){this.store=store,
this.answers=answers,this.playing=playing,this.scene=scene,this.pivots=null,this.held=null,this.handles=s("g",{class:"bs-pivots"}),scene.layer("pivots").append(
this.handles),this.parts=[0,1].map(k=>["F","M"].map(plane=>this.handle(k,plane))),this.story=h("p",{class:"bm-story"}),this.readout=h("output",{class:"bs-placed\
-readout","aria-live":"polite"}),this.letGo=h("button",{type:"button",class:"bs-small",hidden:!0,onclick:()=>this.release()},"Let go of the pivots"),this.curves=
new FamilyCurves(store,answers,playing,scene),this.map=new PivotMapPanel(answers,playing,this),this.element=h("div",{class:"bs-surface"},this.story,h("div",{class:"\
bs-tool"},this.curves.label),this.curves.legend,this.map.element,this.readout,h("div",{class:"bs-tool"},this.letGo)),answers.on("answers",()=>this.renew()),answers.
on("poses",()=>{this.explain(),this.pivots&&store.place(this.pivots)}),answers.on("placed",()=>this.tell()),playing.on("shape",()=>this.show()),playing.on("plac\
e",()=>this.move()),scene.on("view",()=>this.show()),store.on("state document",()=>this.element.classList.toggle("bs-stale",answers.isOld)),this.renew()}get dyads(){
if(this.store.document.poses.some(isPoint2))return[];let placed=this.store.placed?.dyads;return this.pivots&&placed?.length?placed:this.answers.shown?.led??[]}pivot(k,plane){
let dyad=this.dyads[k];if(!dyad)return null;let wanted=this.pivots?.[k],at=wanted?.plane===plane?wanted.at:plane==="F"?dyad.fixed_pivot:dyad.moving_pivot;return at?
{plane,at,id:dyad.id}:null}handle(k,plane){let element=s("g",{class:`bs-pivot bs-pivot-${plane==="F"?"fixed":"moving"} bm-side${k}`,"data-plane":plane,tabindex:0,
role:"button"},s("circle",{class:"bs-hold",r:13}),s("circle",{class:"bs-pivot-ring",r:8})),before;return this.scene.drag?.(element,{start:()=>(before=this.pivots,
this.playing.player.play(!1),this.place=this.playing.here?.place??null,this.take(k,plane)),move:({x,y})=>this.put(plane==="F"?[x,y]:back(this.place,[x,y])),end:()=>this.
drop(),cancel:()=>{this.drop(),before?this.ask(before):this.release()}}),element.addEventListener("keydown",event=>this.key(event,k,plane)),this.handles.append(
element),element}key(event,k,plane){if(event.ctrlKey||event.metaKey)return;let arrow2=ARROWS4[event.key];if(event.key==="Escape"&&this.pivots)this.release();else if(arrow2){
let{at}=this.pivot(k,plane),step=(this.scene.step??this.answers.data.scene/100)*(event.shiftKey?10:event.altKey?.1:1);if(!this.take(k,plane))return;this.put(at.
map((value,axis)=>value+step*arrow2[axis]),step),this.drop()}else return;event.preventDefault()}take(k,plane){let start=this.pivot(k,plane);if(!start||plane==="\
M"&&!this.playing.here)return!1;let other=this.pivots?.[1-k]??this.pivot(1-k,"F")??this.pivot(1-k,"M"),next=[];return next[k]={plane,at:start.at},other&&(next[1-
k]={plane:other.plane,at:other.at}),this.pivots=next,this.held={k,plane},this.keepHeight(),!0}keepHeight(){let{element}=this.playing;element.style.minHeight=`${element.
offsetHeight}px`}put(point2,step=0){let{k,plane}=this.held,digits=decimalsOf(this.answers.data),at=this.curves.onto(plane,point2);at||(at=point2.map(value=>step?
Number(value.toFixed(digits)):this.scene.rounded(value))),this.ask(this.pivots.map((each2,n)=>n===k?{plane,at}:each2))}drop(){this.held=null}ask(pivots){this.pivots=
pivots,this.store.place(pivots.map(({plane,at})=>({plane,at}))),this.show(),this.tell()}release(){this.pivots=null,this.held=null,this.playing.element.style.minHeight=
"",this.store.place([]),this.store.chosen===PLACED&&this.store.choose(this.before??this.answers.linkages[0]?.id??null),this.tell(),this.show()}renew(){let{data}=this.
answers;!this.pivots&&this.store.chosen!==PLACED&&(this.before=this.store.chosen),this.curves.renew(),this.map.renew(),this.explain(),this.show()}explain(){let count=this.
answers.data.poses.length,text=count===4&&this.curves.family?"Four poses leave a curve of dyads. Drag a pivot in the drawing: it slides along its curve.":count===
3?"Three poses leave every pivot free. Drag a fixed pivot anywhere in F, or a moving pivot anywhere on the body.":count===2?"Two poses leave much open. Drag a p\
ivot: its best dyad follows.":"Drag a pivot in the drawing or on the map: the best dyad there is shown with what it costs.";say(this.story,text)}show(){let{view}=this.
scene,place=this.playing.here?.place,there2=this.answers.shown&&!this.answers.shown.gone;this.parts.forEach((planes,k)=>{planes.forEach((element,n)=>{let plane="\
FM"[n],pivot=there2||this.pivots?this.pivot(k,plane):null,seen2=pivot&&(plane==="F"||place);put(element,"display",seen2?"inline":"none"),seen2&&(put(element,"da\
ta-pivot",pivot.id),element.classList.toggle("bs-put",this.pivots?.[k]?.plane===plane),plane==="F"&&put(element,"transform",`translate(${px(view.X(pivot.at[0]))}\
 ${px(view.Y(pivot.at[1]))})`))})}),this.name(),this.move(),this.map.drawHandles()}move(){let{view}=this.scene,place=this.playing.here?.place;place&&this.parts.
forEach(([,element],k)=>{let pivot=element.getAttribute("display")==="none"?null:this.pivot(k,"M");if(!pivot)return;let[x,y]=act(this.held?.k===k&&this.held.plane===
"M"&&this.place?this.place:place,pivot.at);put(element,"transform",`translate(${px(view.X(x))} ${px(view.Y(y))})`)})}name(){if(this.held||this.store.state==="dr\
agging")return;let digits=decimalsOf(this.answers.data);this.parts.forEach((planes,k)=>planes.forEach((element,n)=>{let pivot=this.pivot(k,"FM"[n]);if(!pivot)return;
let text=`${n?"Moving":"Fixed"} pivot of ${pivot.id} at (${pivot.at.map(value=>fixed(value,digits)).join(", ")}) in ${"FM"[n]}. Drag it, or use the arrow keys; \
the best dyad there is shown.`;put(element,"aria-label",text)}))}tell(){let{store,answers}=this,{placed}=store;if(give(this.letGo,"hidden",!this.pivots),!this.pivots||
!placed){say(this.readout,""),!placed&&this.pivots&&!this.held&&store.placeWanted===null&&(this.pivots=null);return}put(this.readout,"aria-live",this.held?"off":
"polite"),say(this.readout,placedInWords(placed,answers.data)),placed.linkage&&store.chosen!==PLACED&&this.pivots&&(this.before=store.chosen,store.choose(PLACED)),
this.show()}};function placedInWords(placed,data){let unit2=data.unit?` ${data.unit}`:"",digits=decimalsOf(data),miss=value=>value===null?"an unknown error":value<
1e-9*data.scene?"nothing":`${figure(value)}${unit2}`,dyads=placed.dyads.map(dyad=>`${dyad.id}: fixed pivot (${dyad.fixed_pivot.map(v=>fixed(v,digits)).join(", ")}\
), moving pivot (${dyad.moving_pivot.map(v=>fixed(v,digits)).join(", ")}), misses by ${miss(dyad.max_error)} at most.`),{linkage}=placed;if(!linkage)return[...dyads,
...(placed.messages??[]).map(({message})=>`${message[0].toUpperCase()}${message.slice(1)}.`)].join(" ");let both=linkage.usable?`usable, ${linkage.said.met}`:`n\
ot usable: ${linkage.said.reasons.join("; ")}`;return`${dyads.join(" ")} Together a ${linkage.type}: ${both}.`}var Assemblies=class{constructor(data,take){this.data=data,this.take=take,this.name=`bm-way-${Math.random().toString(36).slice(2)}`,this.element=h("fieldset",{class:"\
bm-ways"})}build(linkage,index){let one=(way,k)=>h("label",{},h("input",{type:"radio",name:this.name,value:k,checked:k===index,onchange:()=>this.take(k)}),h("sp\
an",{},h("b",{},wayName(way,linkage).replace("assembly ","")),` ${wayStory(way,this.data.poses)}`));this.element.replaceChildren(h("legend",{},"Assembly"),...linkage.
ways.map(one)),give(this.element,"hidden",!linkage.ways.length||!!this.data.whole)}};var TURN_SECONDS=7,TURN=1e-6,NAME_ROWS=5,NUMBER_ROWS=2,MANY_POSES2=100,ROW=13,LONGEST_TICK=18,NO_ERROR2=1e-7,STEPS=360,SPEEDS=[.25,.5,1,2,4],LOOPS=[["back","the\
re and back"],["again","again and again"],["once","once"]],Player=class{parts;steps;tick;wholeLabel;speeds;loops;real;realLabel;constructor(data,show,rebuild){this.
data=data,this.draw={show,rebuild},this.linkage=null,this.way=0,this.u=0,this.heading=1,this.speed=1,this.loop="back",this.isReal=!1,this.whole=!1,this.stretch=
{low:0,high:1,sense:1},this.playing=!1,this.remaining=null,this.element=this.controls()}get path(){return this.linkage?.ways[this.way]}get stop(){return nounOf(
this.data)}controls(){let button2=(name,text,label,onclick)=>h("button",{type:"button",class:`bm-button ${name}`,"aria-label":label,title:label,onclick},text);this.
button=button2("bm-play","","Play",()=>this.play(!this.playing)),this.slider=h("input",{type:"range",class:"bm-slider",min:0,step:"any","aria-label":"Driver",oninput:()=>this.
go(this.turned(Number(this.slider.value)))}),this.box=h("input",{type:"checkbox",onchange:()=>this.playWhole(this.box.checked)}),this.boxName=h("span",{},"Whole\
 branch"),this.stops=s("svg",{class:"bm-stops","aria-hidden":"true"}),this.parts=["","","",""].map(text=>h("span",{},text)),this.readout=h("output",{class:"bm-n\
ow"},this.parts.flatMap((part,k)=>k?[" ",part]:[part])),this.slider.addEventListener("keydown",event=>{let step={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,ArrowUp:1}[event.
key];step&&(event.preventDefault(),this.step(event.shiftKey?10*step:step))});let choice2=(label,entries,take)=>h("select",{class:"bm-pick","aria-label":label,title:label,
onchange:event=>take(event.target.value)},entries.map(([value,text])=>h("option",{value},text)));return this.steps=[button2("bm-back","","",()=>this.toPose(-1)),
button2("bm-next","","",()=>this.toPose(1))],this.speeds=choice2("Speed",SPEEDS.map(each2=>[each2,`${each2} ×`]),value=>this.speed=Number(value)),this.speeds.value=
"1",this.loops=choice2("What comes after the last pose",LOOPS,value=>this.takeLoop(value)),this.real=h("input",{type:"checkbox",onchange:()=>this.isReal=this.real.
checked}),this.realLabel=h("label",{class:"bm-real",hidden:!0,title:"Move as the drive of the task moves it"},this.real,h("span",{},"As driven")),this.wholeLabel=
h("label",{class:"bm-whole"},this.box,this.boxName),this.nameStops(),h("div",{class:"bm-controls"},h("div",{class:"bm-track"},this.slider,this.stops),h("div",{class:"\
bm-row"},this.button,this.steps[0],button2("bm-small-step","‹","A small step back",()=>this.step(-1)),button2("bm-small-step","›","A small step on",()=>this.
step(1)),this.steps[1],this.speeds,this.loops,this.wholeLabel,this.realLabel),this.readout)}nameStops(){let{stop}=this,title=stop[0].toUpperCase()+stop.slice(1);
[[`◀ ${title}`,`Previous ${stop}`],[`${title} ▶`,`Next ${stop}`]].forEach(([text,label],k)=>{say(this.steps[k],text),put(this.steps[k],"aria-label",label),give(
this.steps[k],"title",label)}),give(this.wholeLabel,"title",`Play all that the driver reaches, not only from the first ${stop} to the last`)}load(linkage){this.
linkage=linkage;let counts=linkage.ways.map(way=>way.poses.length);this.take(Math.max(0,counts.indexOf(Math.max(...counts))))}take(index){this.way=index,this.u=
this.firstStop(),this.draw.rebuild()}get stopsOnWay(){return this.linkage.pose_errors.map((row,k)=>({...row,k})).filter(row=>row.way===this.way)}firstStop(){return this.
stopsOnWay[0]?.frame??0}rebuild(){let{path:path2,slider}=this;path2||this.play(!1),this.nameStops();for(let each2 of[slider,this.button])give(each2,"disabled",!path2);
this.linkage&&(this.stretch=stretchOf(this.linkage,this.way,this.whole)),give(this.box,"disabled",!this.stretch.isApart),give(this.realLabel,"hidden",!this.timed),
say(this.boxName,path2?.round?"Whole turn":"Whole branch"),this.heading=1,this.u=clamp(this.u,this.stretch.low,this.stretch.high)}playWhole(on){this.whole=on,this.
draw.rebuild()}drawStops(){let{stops,path:path2}=this,{low,high}=this.stretch;if(stops.replaceChildren(),!path2)return;let width=Math.max(60,this.slider.clientWidth),
inset=9,X=u=>inset+(this.turned(u)-low)/(high-low)*(width-2*inset),rows=this.stopsOnWay.filter(row=>this.data.poses[row.k]).sort((a,b)=>X(a.frame)-X(b.frame)).map(
row=>({...row,x:X(row.frame),pose:this.data.poses[row.k]})),named=laidOut(rows.map(({x,pose})=>({x,text:shortened(poseName(pose),LONGEST_TICK)})),width,NAME_ROWS),
texts=named.every(({at})=>at>=0)?named:laidOut(rows.map(({x,pose})=>({x,text:pose.label})),width,rows.length>MANY_POSES2?1:NUMBER_ROWS),deepest=Math.max(0,...texts.
map(({at})=>at)),one=(k,pose,...parts)=>s("g",{"data-pose":k+1},s("title",{},calledOf(pose)),...parts);rows.forEach(({k,x,pose},i)=>stops.append(one(k,pose,s("p\
ath",{d:`M${px(x)} 0V${4+ROW*Math.max(0,texts[i].at)}`})))),rows.forEach(({k,pose},i)=>{let{at,middle:middle2,text}=texts[i];at>=0&&stops.append(one(k,pose,s("t\
ext",{x:px(middle2),y:14+ROW*at,"text-anchor":"middle"},text)))}),put(stops,"viewBox",`0 0 ${width} ${16+ROW*deepest}`),put(stops,"height",16+ROW*deepest)}play(on){
if(on&&!this.path||(this.remaining=null,on===this.playing&&this.isDressed)||(this.isDressed=!0,this.playing=on,put(this.readout,"aria-live",on?"off":"polite"),this.
button.replaceChildren(icon(on),on?"Pause":"Play"),put(this.button,"aria-label",on?"Pause":"Play"),this.button.title=on?"Pause (space)":"Play (space)",cancelAnimationFrame(
this.tick),!on))return;let before=null,run=now=>{this.playing&&(before!==null&&this.advance(Math.min(.1,(now-before)/1e3)),before=now,this.playing&&(this.tick=requestAnimationFrame(
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
null?0:place.a-radians(pose.angle_deg),away2=Math.hypot(place.x-pose.x,place.y-pose.y,this.data.chart.length*(turn-2*Math.PI*Math.round(turn/(2*Math.PI))));away2<
least2&&([near2,least2]=[k,away2])}),near2}show(told=!0){let{path:path2}=this;if(!path2){for(let part of this.parts)part.textContent="";return}let place=this.placeAt(
this.u),drive=linear(path2.drive,this.u),transmission=linear(path2.transmission,this.u),near2=this.atPose=this.nearest(place);told&&(give(this.slider,"min",this.
stretch.low),give(this.slider,"max",this.stretch.high),give(this.slider,"value",this.turned(this.u)),this.tell(place,drive,transmission,near2)),this.draw.show(place,
drive,transmission,near2)}driverText(drive){let{data,linkage}=this;return linkage.led[0].kind==="PR"?`${fixed(drive,decimalsOf(data))}${data.unit?` ${data.unit}`:
""}`:`${linkage.crank??""}${fixed(drive,1)}°`}tell(place,drive,transmission,near2){let{data,linkage}=this,unit2=data.unit?` ${data.unit}`:"",digits=decimalsOf(
data),driver=this.driverText(drive),pose=data.poses[near2],row=linkage.pose_errors[near2],at=row?.at===this.path&&Math.abs(row.frame-this.u)<1e-6,away2=()=>`${figure(
Math.hypot(place.x-pose.x,place.y-pose.y))}${unit2} from ${calledOf(pose)}`,missed2=()=>`at ${calledOf(pose)}, ${row.said.position==="exact"?"":"off by "}${missOf(
row.said.position,row.said.turned,unit2)}`,said=pose?pose.called?`${at?"at":"near"} ${pose.called}`:at?missed2():away2():"between the poses",time=this.isReal&&this.
timed&&drive!==null?valueAt(this.timed.time,drive):null,texts=[...this.path.told?.map(each2=>this.toldOf(each2))??[`driver ${driver}${time===null?"":` at ${fixed(
time,2)} s`}`,`body (${fixed(place.x,digits)}, ${fixed(place.y,digits)})${unit2}, ${fixed(((degrees(place.a)+180)%360+360)%360-180,2)}°`],`transmission ${transmission===
null?"–":`${fixed(transmission,1)}°`}`,said];texts.forEach((text,k)=>{let whole=k+1<texts.length?`${text} ·`:text;this.parts[k].textContent!==whole&&(this.parts[k].
textContent=whole)}),put(this.slider,"aria-valuetext",`${texts[0]}, ${texts[3]}`)}toldOf({name,digits,values,panel}){let error=panel===void 0?null:valueAt(this.
linkage.panels[panel],smooth(this.path.drive,this.u)),off=error===null?"":`, off by ${Math.abs(error)<NO_ERROR2?"0":figure(error)}°`;return`${name} ${fixed(smooth(
values,this.u),digits)}°${off}`}};function laidOut(texts,width,count){let ends=Array(count).fill(-99);return texts.map(({x,text})=>{let size2=6.4*text.length,left=clamp(
x-size2/2,0,Math.max(0,width-size2)),at=ends.findIndex(end=>left>end+4);return at>=0&&(ends[at]=left+size2),{text,at,middle:left+size2/2}})}var around2=(u,turn)=>(u%
turn+turn)%turn;function icon(pause){return s("svg",{width:12,height:12,viewBox:"0 0 12 12","aria-hidden":"true"},s("path",{d:pause?"M1 0h3.5v12H1zM7.5 0H11v12H\
7.5z":"M1 0l11 6l-11 6z"}))}var APART2=3,GOLDEN=.381966011250105,HALVINGS=24;function drivenByOther(linkage,length){let led=[linkage.led[1],linkage.led[0]];if(led[0].kind==="PP"||!linkage.
ways.length)return{...linkage,led,loads:null,ways:[],pose_errors:linkage.pose_errors.map(row=>({...row,way:null,frame:null,at:null}))};let ways=[],places=Array(
linkage.pose_errors.length).fill(null);for(let chain of chainsOf(linkage.ways))for(let piece of piecesOf(linkage,led[0],chain,length)){let way=wayOf(linkage,led,
piece,chain,length),number=ways.push(way)-1;linkage.pose_errors.forEach((row,k)=>{let frame=places[k]||row.way===null?null:frameIn(piece,row,linkage.ways[row.way].
x.length-1);frame!==null&&(places[k]=[number,way.falls?piece.stations.length-1-frame:frame],way.poses.push(k+1))})}let named=new Map;for(let way of ways)way.branches=
ways.filter(each2=>each2.circuit===way.circuit).length,named.set(way.circuit,(named.get(way.circuit)??0)+1),way.branch=named.get(way.circuit);let pose_errors=linkage.
pose_errors.map((row,k)=>({...row,way:places[k]?.[0]??null,frame:places[k]?.[1]??null,at:places[k]?ways[places[k][0]]:null,transmission_deg:row.x===null?null:transmissionOf(
led[0],led[1],{x:row.x,y:row.y,a:row.angle_deg*Math.PI/180})}));return{...linkage,led,loads:null,ways,pose_errors}}function chainsOf(ways){let chains=[];for(let circuit of new Set(
ways.map(way=>way.circuit))){let own=ways.map((way,number)=>({way,number})).filter(({way})=>way.circuit===circuit),stations=({way,number},turned)=>{let all=Array.
from(way.x,(_,u)=>({way:number,u}));return turned?all.reverse():all},[one,other]=own,joined=(end,start)=>other&&one.way.dead[end]&&other.way.dead[start]&&near(one.
way,end,other.way,start);if(!other||!(joined(0,0)||joined(1,1))){for(let each2 of own)chains.push({circuit,closed:each2.way.round,stations:stations(each2,!1)});
continue}let closed2=joined(0,0)&&joined(1,1),high=joined(1,1),through=[...stations(one,!high),...stations(other,high).slice(1)];chains.push({circuit,closed:closed2,
stations:through})}return chains}function near(one,end,other,start){let at=(way,k)=>[way.x[k],way.y[k]],last=(way,k)=>k?way.x.length-1:0,[i,j]=[last(one,end),last(
other,start)],inner=end?i-1:1,step=Math.hypot(...at(one,i).map((v,k)=>v-at(one,inner)[k]));return Math.hypot(...at(one,i).map((v,k)=>v-at(other,j)[k]))<=APART2*
step+1e-9*Math.hypot(...at(one,i))}function piecesOf(linkage,driver,{circuit,closed:closed2,stations},length){let placeOf2=({way,u})=>placeAt(linkage,linkage.ways[way],
u,length),slides=driver.kind==="PR",before=null,driveAt=station=>{let drive=driveOf(driver,placeOf2(station));return!slides&&before!==null&&(drive-=2*Math.PI*Math.
round((drive-before)/(2*Math.PI))),drive},drives=stations.map(station=>before=driveAt(station)),count=stations.length-1,sense=k=>Math.sign(drives[k+1]-drives[k]),
cuts=[];for(let k=1;k<count;k+=1)sense(k)*sense(k-1)<0&&cuts.push(k);if(closed2&&sense(0)*sense(count-1)<0&&cuts.push(0),!cuts.length)return[{circuit,round:closed2,
dead:[!1,!1],stations}];let dead=new Map(cuts.map(k=>[k,extreme(k)]));function extreme(k){let here=stations[k],up=drives[k]>drives[k===0?1:k-1]?1:-1;before=drives[k];
let sides=[k>0?k-1:count-1,k+1].map(at2=>{let there2=stations[at2];return there2.way===here.way&&Math.abs(there2.u-here.u)<1.5?[here.way,here.u,there2.u]:[there2.
way,there2.u,there2.u<1.5?0:there2.u+1]}),value=(way,u)=>up*driveAt({way,u}),best={station:here,value:value(here.way,here.u)};for(let[way,u,v]of sides){let[low,
high]=[Math.min(u,v),Math.max(u,v)];for(let step=0;step<HALVINGS;step+=1){let[a,b]=[low+GOLDEN*(high-low),high-GOLDEN*(high-low)];value(way,a)<value(way,b)?low=
a:high=b}let station={way,u:(low+high)/2},found=value(way,station.u);found>best.value&&(best={station,value:found})}return best.station}let part=(from,to)=>{let inner=[];
for(let k=from+1;k<to;k+=1)inner.push(stations[closed2?k%count:k]);let ends=[from,to].map(k=>dead.get(closed2?k%count:k)??stations[k]);return[ends[0],...inner.filter(
each2=>!ends.some(end=>end.way===each2.way&&Math.abs(end.u-each2.u)<.001)),ends[1]]};if(cuts.sort((a,b)=>a-b),closed2){let at2=[...cuts,cuts[0]+count];return at2.
slice(1).map((to,k)=>({circuit,round:!1,dead:[!0,!0],stations:part(at2[k],to)}))}let at=[0,...cuts,count];return at.slice(1).map((to,k)=>({circuit,round:!1,dead:[
k>0,to<count],stations:part(at[k],to)}))}function wayOf(linkage,led,piece,chain,length){let slides=led[0].kind==="PR",places=piece.stations.map(({way,u})=>({...placeAt(
linkage,linkage.ways[way],u,length)})),drive=[];places.forEach((place,k)=>{let value=driveOf(led[0],place);!slides&&k&&(value-=2*Math.PI*Math.round((value-drive[k-
1])/(2*Math.PI))),k&&(place.a-=2*Math.PI*Math.round((place.a-places[k-1].a)/(2*Math.PI))),drive.push(value)});let falls=drive[drive.length-1]<drive[0];falls&&[drive,
places].forEach(each2=>each2.reverse());let turns=slides?0:2*Math.PI*Math.round((drive[0]+drive[drive.length-1])/(4*Math.PI));return{circuit:chain.circuit,round:piece.
round,dead:falls?[...piece.dead].reverse():piece.dead,poses:[],falls,drive:drive.map(value=>slides?value:degrees(value-turns)),x:places.map(({x})=>x),y:places.map(
({y})=>y),angle:places.map(({a})=>a),transmission:places.map(place=>transmissionOf(led[0],led[1],place))}}function frameIn({stations},{way,frame},last){for(let k=0;k+
1<stations.length;k+=1){let[a,b]=[stations[k],stations[k+1]];if(a.way!==way||b.way!==way){if(a.way===way&&Math.abs(a.u-frame)<1e-9)return k;if(b.way===way&&Math.
abs(b.u-frame)<1e-9)return k+1;continue}let[u,v]=Math.abs(b.u-a.u)>last/2?[a,b].map(each2=>each2.u+(each2.u<last/2?last:0)):[a.u,b.u];for(let at of[frame,frame+
last]){if(at>=Math.min(u,v)-1e-9&&at<=Math.max(u,v)+1e-9)return u===v?k:k+(at-u)/(v-u);if(Math.max(u,v)<=last)break}}return null}var REDUCED_MOTION="(prefers-reduced-motion: reduce)",AT_POSE=1e-6,Playing=class extends Events{constructor(store,answers){super(),this.store=store,this.answers=
answers,this.isOther=!1,this.here=null,this.player=new Player(answers.data,(place,drive,transmission,near2)=>this.placed({place,drive,transmission,near:near2}),
()=>this.rebuild()),this.assemblies=new Assemblies(answers.data,index=>this.player.take(index)),this.drivers=h("fieldset",{class:"bm-ways bs-drivers",hidden:!0}),
this.note=h("p",{class:"bs-quiet bs-driver-note"}),this.element=h("div",{class:"bs-player"},this.player.element,h("div",{class:"bs-player-ways"},this.drivers,this.
assemblies.element),this.note),this.words=new Pace(()=>this.player.path&&this.player.show()),this.marks=new Pace(()=>this.player.drawStops()),answers.on("answer\
s shown placed",()=>this.load()),answers.on("moved",()=>this.follow()),store.on("selection",()=>this.goToSelected()),store.on("state",()=>this.hush()),new ResizeObserver(
()=>this.marks.ask()).observe(this.element),this.load()}get linkage(){return this.player.linkage}get path(){return this.player.path}load(){let base=this.answers.
shown??null;if(base===this.base&&base){this.follow(),this.tellDriver();return}if(this.base=base,this.isOther=!1,this.at=null,this.dress(),!base){this.player.linkage=
null,this.player.way=0,this.player.play(!1);for(let each2 of[this.assemblies.element,this.drivers])give(each2,"hidden",!0);say(this.note,""),this.element.classList.
add("bs-empty"),this.emit("shape",!1);return}this.element.classList.remove("bs-empty"),this.player.load(this.driven()),this.goToSelected()}driven(){return this.
isOther?drivenByOther(this.base,this.answers.data.chart.length):this.base}driveBy(other){this.isOther=other,this.player.linkage=this.driven(),this.at=null,this.
takeBest(),this.rebuild(),this.tellDriver()}takeBest(){let counts=this.linkage.ways.map(way=>way.poses.length);this.player.way=Math.max(0,counts.indexOf(Math.max(
...counts))),this.player.u=this.player.firstStop()}follow(){let{base,player}=this;if(!base)return;player.linkage=this.driven();let row=this.at?.pose===void 0?null:
player.linkage.pose_errors[this.at.pose];row&&row.way!==null?(player.way=row.way,player.u=row.frame):player.path?this.at&&(player.u=this.frameOf(player.path,this.
at.drive)):player.linkage.ways.length&&this.takeBest(),player.rebuild(),this.emit("shape",!0),player.show(!1),this.words.ask(),this.marks.ask()}frameOf(way,drive){
if(drive===null||this.linkage.led[0].kind==="PR")return frameAt(way.drive,drive??way.drive[0]);let middle2=(way.drive[0]+way.drive[way.drive.length-1])/2;return frameAt(
way.drive,drive-360*Math.round((drive-middle2)/360))}rebuild(){let{player}=this;player.rebuild(),this.assemblies.build(this.linkage,player.way),this.buildDrivers(),
this.emit("shape",!1),this.marks.ask(),player.show()}placed(here){this.here=here;let{path:path2,u}=this.player,pose=this.linkage.pose_errors.findIndex(row=>row.
at===path2&&Math.abs(row.frame-u)<AT_POSE);this.at={drive:here.drive,pose:pose<0?void 0:pose},this.emit("place",here)}goToSelected(){let{selection}=this.store,{
player}=this;if(selection?.kind!=="pose"||player.playing)return;let row=this.linkage?.pose_errors[selection.index];if(!row||row.way===null)return;let other=row.
way!==player.way;player.way=row.way,player.u=row.frame,other?this.rebuild():player.go(row.frame)}buildDrivers(){let{base}=this;if(give(this.drivers,"hidden",!base||
!base.ways.length||base.led.some(dyad=>dyad.kind==="PP")),this.drivers.hidden)return;let key=`${base.id} ${base.led.map(dyad=>dyad.id)} ${this.isOther}`;if(key===
this.driversKey)return;this.driversKey=key;let one=(dyad,other)=>h("label",{},h("input",{type:"radio",name:"bs-driver",checked:other===this.isOther,"data-driver":dyad.
id,onchange:()=>this.driveBy(other)}),h("span",{},h("b",{},dyad.id),` ${{RR:"crank or rocker",PR:"slider on its rail",RP:"slot"}[dyad.kind]}`));this.drivers.replaceChildren(
h("legend",{},"Driver"),one(base.led[0],!1),one(base.led[1],!0)),this.tellDriver()}tellDriver(){let{base}=this;if(!base?.drives||base.followed){say(this.note,"");
return}let driver=this.isOther?base.led[1]:base.led[0],drive=base.dyads[0].id===driver.id?base.drives.first:base.drives.second,least2=drive.min_transmission_angle_deg.
range,said=drive.defects.length?drive.defects.map(each2=>each2.message).join("; "):`${drive.turns_fully?"turns fully":"reaches every pose"}${least2===null?"":`,\
 transmission angle ${fixed(least2,1)}° or more between the poses`}`;say(this.note,`Driven by ${driver.id}: ${said}.`)}dress(){this.driversKey=null}hush(){let quiet=this.
store.state==="dragging"||this.player.playing;put(this.player.readout,"aria-live",quiet?"off":"polite")}};function playOnce(store,answers,{player}){if(matchMedia(
REDUCED_MOTION).matches)return;let first=!0;answers.on("answers",()=>{first&&player.path&&(first=!1,player.playOnce())}),store.on("document selection",()=>{first=
!1,player.remaining!==null&&player.play(!1)})}var ORDERS={rank:{name:"best first",of:linkage=>linkage.rank??1/0},worst:{name:"worst miss",of:linkage=>linkage.worst??1/0},least:{name:"transmission angle",of:linkage=>-(linkage.
least??-1)},size:{name:"size",of:linkage=>linkage.quality?.extent??1/0},sensitivity:{name:"sensitivity",of:linkage=>linkage.quality?.sensitivity??1/0}},FILTERS={
all:{name:"all",holds:()=>!0},usable:{name:"usable",holds:linkage=>linkage.usable},pinned:{name:"pinned",holds:(linkage,pinned)=>pinned.has(linkage.id)}};function arranged(linkages,{
order,filter,type,pinned}){let{of}=ORDERS[order],{holds}=FILTERS[filter];return linkages.filter(each2=>holds(each2,pinned)&&(!type||each2.type===type)).map((each2,k)=>({
each:each2,k,key:of(each2)})).sort((a,b)=>Number(pinned.has(b.each.id))-Number(pinned.has(a.each.id))||(a.key===b.key?0:a.key-b.key)||a.k-b.k).map(({each:each2})=>each2)}var FIGURES=[["worst","worst miss"],["least","transmission"],["size","size"],["sensitivity","sensitivity"]],ResultCard=class{constructor(does){this.name=h("b",{}),
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
called==="By hand"?"Let go of the pivots":"Put it away");for(let button2 of[this.pin,this.compare,this.improve])labelled2(button2,linkage.id)}tellBetter(sentences){
this.better.replaceChildren(...sentences.map(sentence2=>h("li",{},sentence2)))}};function pastOf({was,shift,isNew,followed}){if(isNew&&!was)return"new";let moved2=shift&&
!followed?`moved ${(100*shift).toFixed(1)} %`:"";return[was?`was ${was}`:"",moved2].filter(Boolean).join(", ")}function least(linkage){let angle=leastOf(linkage);
return angle==="–"?angle:angle==="0°"?"down to 0°":`${angle} or more`}function setPressed(button2,on){put(button2,"aria-pressed",!!on)}function labelled2(button2,id){
put(button2,"aria-label",`${button2.textContent}: ${id}`)}var History=class{onchange=()=>{};constructor(kept2={past:[],future:[]}){this.past=kept2.past.map(value=>({value,gesture:null})),this.future=[...kept2.future]}kept(room){
let some2=list=>{let out=[];for(let k=list.length-1;k>=0&&(room-=JSON.stringify(list[k]).length)>0;k-=1)out.unshift(list[k]);return out};return{past:some2(this.
past.map(({value})=>value)),future:some2(this.future)}}record(value,gesture){this.future=[];let last=this.past.at(-1);gesture!==null&&last?.gesture===gesture||(this.
past.push({value,gesture}),this.past.length>500&&this.past.shift(),this.onchange())}undo(value){let last=this.past.pop();return last?(this.future.push(value),last.
value):null}redo(value){let next=this.future.pop();return next===void 0?null:(this.past.push({value,gesture:null}),next)}abandon(gesture){return this.past.at(-1)?.
gesture!==gesture?null:this.past.pop()?.value}get canUndo(){return this.past.length>0}get canRedo(){return this.future.length>0}};var REST2=150,MOST_REST=1e3,MOST_FLYING=1,MOST_SHOWN=6,FEWEST=2,QUICK=1.2,NO_ANSWER={linkages:[],dyads:[],best:[],warnings:[],pivot_map:null,family_map:null,outcome:{
message:"Two poses or more make a task"}},PLACED2="placed",kindOf=({poses,path:path2})=>`${poses.map(({free})=>free?.join("")??"-").join()} ${path2?path2.closed:
""}`,Store=class{solving;placing;solved;constructor({connection,document:document2,options={},name="task",settings={},filters={},choice:choice2=null,picture=null,
history:history2=void 0,mostFlying=MOST_FLYING}){this.connection=connection,this.mostFlying=mostFlying,this.renamed=new Map,this.moved=new Map,this.document=document2,
this.options=options,this.name=name,this.settings=settings,this.filters=filters,this.picture=picture,this.wanted=choice2&&{...choice2,document:document2},this.history=
new History(history2),this.history.onchange=()=>this.emit("history"),this.solved=null,this.solvedFor=null,this.followed=null,this.followedFor=null,this.state="r\
esting",this.progress="",this.chosen=null,this.pinned=new Set,this.compared=null,this.placed=null,this.whole=null,this.task=0,this.solvedTask=0,this.selection=null,
this.reference=0,this.isOnBody=!1,this.messages=[],this.listeners=new Map,this.basis=null,this.pending=null,this.flying=new Map,this.placing=null,this.solving=null,
connection.on("message",message=>this.take(message)),connection.on("open",()=>this.opened()),connection.on("closed",()=>this.closed())}on(names,fn){for(let name of[
names].flat().join(" ").split(/\s+/))this.listeners.has(name)||this.listeners.set(name,[]),this.listeners.get(name).push(fn)}emit(...names){let told=new Set;for(let name of names)
for(let fn of this.listeners.get(name)??[])told.has(fn)||(told.add(fn),fn(name))}edit(change,{gesture=null,options=this.options,picture=this.picture}={}){let next=change(
this.document);if(next===this.document)return;this.history.record(this.version,gesture);let hasMoved=picture!==this.picture;Object.assign(this,{document:next,options,
picture}),this.changed(),hasMoved&&this.emit("picture")}option(name,value){this.history.record(this.version,null);let{[name]:_,...rest}=this.options;this.options=
value===void 0?rest:{...rest,[name]:value},this.changed()}setting(name,value){this.history.record(this.version,null),this.settings=withKeys(this.settings,{[name]:value}),
this.emit("document")}rename(name){this.history.record(this.version,null),this.name=name,this.emit("document")}filter(name,value){this.history.record(this.version,
name),this.filters={...this.filters,[name]:value},this.emit("filters")}setPicture(changes,gesture=null){this.history.record(this.version,gesture),this.picture=changes&&
{...this.picture,...changes},this.emit("picture")}replace({document:document2,options={},name=this.name,settings=this.settings,picture=null}){this.history.record(
this.version,null),this.tasks=(this.tasks??0)+1,this.document=document2,this.options=options,this.name=name,this.settings=settings,this.picture=picture,this.selection=
null,this.reference=0,this.placed=null,this.task=this.tasks,this.changed(),this.emit("selection","placed","reference","picture")}undo(){this.goTo(this.history.undo(
this.version))}redo(){this.goTo(this.history.redo(this.version))}abandon(gesture){this.goTo(this.history.abandon(gesture))}get version(){let{document:document2,
options,name,settings,task,filters,picture,choice:choice2}=this;return{document:document2,options,name,settings,task,filters,picture,choice:choice2}}get choice(){
return{chosen:this.chosen,compared:this.compared,pinned:[...this.pinned]}}goTo(version){if(!version)return;let{choice:choice2,...task}=version,isSame=task.document===
this.document&&task.options===this.options;return Object.assign(this,task),this.emit("filters","picture"),this.wanted={...choice2,document:task.document},isSame?
(this.solvedFor===task.document&&(this.takeWanted(),this.showChosen()),this.emit("document")):this.changed()}changed(){this.placed?.cognateOf&&this.letCognateGo(),
this.follow(),this.emit("document"),this.isEmpty&&this.forget(),this.state!=="offline"&&this.setState("dragging"),this.solveAfterRest()}get shown(){return[...new Set(
[this.chosen,this.compared,...this.pinned])].filter(id=>id&&id!==PLACED2).slice(0,MOST_SHOWN)}follow(){if(!this.solved||this.flying.size>=this.mostFlying)return;
if(!this.canFollow){this.solveMeanwhile();return}let{document:document2,options,shown:shown2}=this,n=this.connection.send({do:"follow",document:document2,options,
shown:shown2});n!==null&&this.flying.set(n,{document:document2,isOld:!1})}get canFollow(){return this.whole!==kindOf(this.document)}get slow(){return this.canFollow||
this.seconds===void 0?null:this.seconds}solveMeanwhile(){if(this.solving||this.state==="offline"||this.isEmpty||this.slow===null||this.slow>QUICK)return;let{document:document2,
options}=this,n=this.connection.send({do:"solve",document:document2,options});n!==null&&(this.solving={n,document:document2,options})}solveAfterRest(){clearTimeout(
this.resting);let since=performance.now(),rest=()=>{this.flying.size&&performance.now()-since<MOST_REST?this.resting=setTimeout(rest,REST2/3):this.solve()};this.
resting=setTimeout(rest,REST2)}solve(){clearTimeout(this.resting);let{document:document2,options}=this;if(this.solving?.document===document2&&this.solving.options===
options){this.setState("solving","");return}let n=this.connection.send({do:"solve",document:document2,options});n!==null&&(this.solving={n,document:document2,options},
this.setState("solving",""))}cancel(){this.connection.send({do:"cancel"})}place(pivots){this.placeWanted=pivots?.length?pivots:null,this.placeWanted?this.placing||
this.sendPlace():(this.placed=null,this.emit("placed"))}sendPlace(){let{document:document2,options,placeWanted:pivots}=this,n=this.connection.send({do:"place",document:document2,
options,pivots});this.placing=n===null?null:{n,pivots}}take(message){let{n,kind}=message;kind==="ended"&&this.say(message.messages.map(each2=>({tone:kind,...each2}))),
kind==="followed"?this.takeFollowed(message):this.flying.has(n)?this.followRefused(message):n===this.placing?.n?this.takePlaced(message):(n===this.solving?.n||kind===
"cancelled"&&this.solving&&n>this.solving.n)&&this.takeSolving(message)}takeFollowed(frame){let asked=this.flying.get(frame.n);if(!asked)return;let{document:document2,
isOld}=asked,from=frame.from??(isOld?null:this.basis);this.flying.delete(frame.n),this.pending&&from===this.pending.n&&this.install(this.pending),this.goOn(document2);
let isThere=document2===this.solvedFor&&!this.followed;from===this.basis&&!isThere&&(this.followed=frame,this.followedFor=document2,this.emit("followed")),!this.
flying.size&&![this.followedFor,this.solvedFor].includes(this.document)&&this.follow()}goOn(document2){[document2,...[...this.flying.values()].map(each2=>each2.
document)].includes(this.document)||this.follow()}followRefused({n,kind,messages=[],solve=!1,whole=!1}){let{document:document2}=this.flying.get(n);this.flying.delete(
n),kind==="refused"&&!solve&&this.say(messages),whole&&(this.whole=kindOf(document2)),this.goOn(document2)}takePlaced(message){let{pivots}=this.placing;this.placing=
null,this.placeWanted&&message.kind==="placed"?(this.placed={...message,pivots},this.emit("placed")):message.kind==="refused"&&this.say(message.messages),this.placeWanted&&
this.placeWanted!==pivots&&this.sendPlace()}takeSolving(message){let{document:document2}=this.solving,isNow=document2===this.document,isAnother=this.solvedTask!==
this.task;if(message.kind==="progress"||message.kind==="waiting"){let before=`waiting for ${message.before} other${message.before===1?"":"s"}`;isNow&&this.setState(
"solving",message.kind==="progress"?message.text:before);return}if(message.kind!=="solving"){if(this.solving=null,message.kind==="solved"){let answer={...message,
document:document2};isNow||!this.canFollow?this.install(answer):this.pending=answer}else isAnother&&this.forget("There is no answer to this task yet");if(message.
kind==="refused")this.say(message.messages);else if(!["solved","ended"].includes(message.kind)){let[said]=[message.message].flat();this.say([{tone:message.kind,
...typeof said=="string"?{message:said}:said}])}isNow&&this.setState("resting","")}}get isEmpty(){return this.document.poses.length<FEWEST}forget(message=NO_ANSWER.
outcome.message){if(!this.solved)return;let result={...this.solved,...NO_ANSWER,outcome:{message},space:{...this.solved.space,quadrics:[]}};this.install({n:null,
result,document:this.document,seconds:null,was:void 0}),this.placed&&this.place([])}install({n,result,document:document2,seconds,was}){let told=Object.entries(was??
{});if(this.renamed=new Map(told.map(([now,{id}])=>[id,now])),this.moved=new Map(told.map(([now,{moved:moved2}])=>[now,moved2])),!told.length&&document2===this.
solvedFor&&!this.followed)for(let{id}of result.linkages)this.renamed.set(id,id);let carried=id=>id===PLACED2&&this.placed?.linkage?id:this.renamed.get(id)??null;
this.isAnother=this.solvedTask!==this.task,this.solved=result,this.solvedFor=document2,this.solvedTask=this.task,this.seconds=seconds,this.basis=n,this.whole=null,
this.pending=null,this.followed=null,this.followedFor=null;for(let each2 of this.flying.values())each2.isOld=!0;this.chosen=carried(this.chosen)??result.linkages[0]?.
id??null,this.compared=carried(this.compared),this.pinned=new Set([...this.pinned].map(carried).filter(Boolean)),this.wanted?.document===document2&&this.takeWanted(),
this.messages=[],this.emit("solved","chosen","pinned","messages"),document2!==this.document&&this.follow()}takeWanted(){let{chosen,compared,pinned=[]}=this.wanted,
isThere=id=>id===PLACED2?!!this.placed:this.solved.linkages.some(each2=>each2.id===id);isThere(chosen)&&(this.chosen=chosen),this.compared=isThere(compared)?compared:
null,this.pinned=new Set(pinned.filter(isThere)),this.wanted=null}takeCognate(linkage,of){this.placeWanted=null,this.placed={linkage,dyads:[],pivots:[],cost:null,
messages:[],cognateOf:of},this.chosen=PLACED2,this.emit("placed","chosen")}letCognateGo(){let{cognateOf}=this.placed;this.placed=null,this.chosen===PLACED2&&(this.
chosen=cognateOf),this.emit("placed","chosen")}opened(){this.flying.clear(),this.solving=this.placing=null,this.setState("resting",""),this.basis=null,this.solve()}closed(){
clearTimeout(this.resting),this.flying.clear(),this.solving=this.placing=null,this.setState("offline","")}setState(state,progress=""){state===this.state&&progress===
this.progress||(this.state=state,this.progress=progress,this.emit("state"))}say(messages){this.messages=messages,this.emit("messages")}choose(id){id!==this.chosen&&
(this.history.record(this.version,"choose"),this.chosen=id,this.showChosen())}showChosen(){this.emit("chosen","pinned"),(this.state==="dragging"||this.document!==
this.solvedFor)&&this.follow()}pin(id){this.history.record(this.version,null),this.pinned.delete(id)||this.pinned.add(id),this.emit("pinned")}compare(id){this.history.
record(this.version,"compare"),this.compared=id===this.compared?null:id,this.emit("chosen")}select(selection){["kind","index","indices"].every(key=>String(selection?.[key])===
String(this.selection?.[key]))||(this.selection=selection,this.emit("selection"))}get selectedPoses(){let{selection,document:document2}=this;return selection?.kind===
"pose"?(selection.indices??[selection.index]).filter(k=>k<document2.poses.length):[]}selectPoses(indices,index=indices.at(-1)){this.select(indices.length?{kind:"\
pose",index:indices.includes(index)?index:indices.at(-1),indices:indices.length>1?indices:void 0}:null)}selectAlso(index){let before=this.selectedPoses;this.selectPoses(
before.includes(index)?before.filter(k=>k!==index):[...before,index],index)}get referenceIndex(){return Math.min(this.reference,this.document.poses.length-1)}setReference(index){
this.reference=index,this.emit("reference")}};var MOST4=40,Results=class{constructor(store,answers){this.store=store,this.answers=answers,this.cards=new Map,this.wanted={order:"rank",filter:"all",type:""},this.
all=!1;let choice2=(name,entries,key)=>h("label",{},`${name} `,h("select",{"data-choice":key,onchange:event=>this.want(key,event.target.value)},entries.map(([value,
text])=>h("option",{value},text))));this.types=choice2("Type",[["","any"]],"type"),this.title=h("h2",{},"Linkages"),this.status=h("p",{class:"bs-results-status",
role:"status"}),this.doubt=h("p",{class:"bs-doubt"}),this.gone=h("p",{class:"bs-gone-note"}),this.list=h("div",{class:"bs-cards"}),this.more=h("button",{type:"b\
utton",class:"bs-small",hidden:!0,onclick:()=>this.showAll()}),this.element=h("section",{class:"bs-results","aria-label":"Linkages"},h("div",{class:"bs-results-\
head"},this.title,this.status,this.doubt,this.gone,h("div",{class:"bs-choices"},choice2("Show",Object.entries(FILTERS).map(([key,{name}])=>[key,name]),"filter"),
choice2("Sort by",Object.entries(ORDERS).map(([key,{name}])=>[key,name]),"order"),this.types)),this.list,this.more),this.pace=new Pace(()=>this.update()),this.list.
addEventListener("keydown",event=>this.walk(event)),answers.on("answers placed",()=>this.arrange()),answers.on("moved",()=>this.pace.ask()),answers.on("shown",()=>this.
update()),store.on("pinned",()=>this.arrange()),store.on("state document",()=>this.tell()),this.arrange()}want(key,value){this.wanted[key]=value,this.arrange()}showAll(){
this.all=!0,this.arrange()}arrange(){let{answers,store,wanted}=this;this.buildTypes();let every=arranged(answers.linkages,{...wanted,pinned:store.pinned}),shown2=this.
all?every:every.slice(0,MOST4),list=answers.placed?[answers.placed,...shown2]:shown2,cards=new Map;for(let linkage of list)cards.set(linkage,this.cards.get(linkage)??
this.card());for(let[linkage,card]of this.cards)cards.has(linkage)||card.element.remove();this.cards=cards;let before=null;for(let card of cards.values()){let next=before?
before.nextSibling:this.list.firstChild;card.element!==next&&this.list.insertBefore(card.element,next),before=card.element}give(this.more,"hidden",every.length<=
shown2.length),this.more.hidden||say(this.more,`Show all ${every.length}`),this.hidden=answers.linkages.length-every.length,this.update()}card(){let{store}=this;
return new ResultCard({choose:id=>store.choose(id),pin:id=>store.pin(id),compare:id=>store.compare(id),improve:id=>this.improve(id),letGo:()=>this.letGo()})}letGo(){
this.store.placed?.cognateOf?this.store.letCognateGo():this.store.place([]),this.store.chosen===PLACED&&this.store.choose(this.answers.linkages[0]?.id??null)}buildTypes(){
let types=[...new Set(this.answers.linkages.map(each2=>each2.type))].sort(),key=types.join(),select=this.types.querySelector("select");key!==this.typesKey&&(this.
typesKey=key,types.includes(this.wanted.type)||(this.wanted.type=""),select.replaceChildren(...["",...types].map(type=>h("option",{value:type,selected:type===this.
wanted.type},type||"any"))),give(this.types,"hidden",types.length<2))}update(){let{answers,store}=this,{data,isOld,shown:shown2}=answers;for(let[linkage,card]of this.
cards)card.show(linkage,{data,old:isOld&&linkage.id!==PLACED,chosen:linkage===shown2,pinned:store.pinned.has(linkage.id),compared:store.compared===linkage.id});
this.tell()}tell(){let{answers,store}=this,there2=answers.linkages.filter(each2=>!each2.gone),usable=there2.filter(each2=>each2.usable).length;say(this.title,there2.
length?`${there2.length} linkage${there2.length===1?"":"s"}, ${usable} usable`:store.solved?"No linkage":"Linkages"),put(this.status,"aria-live",store.state==="\
dragging"?"off":"polite"),say(this.status,this.statusText());let uncertain=store.followed?.uncertain??[];say(this.doubt,store.followed&&answers.isOld?uncertain.
length?`May change when you let go: ${uncertain[0]}${/[.!]$/.test(uncertain[0])?"":"."}`:store.followed.complete===!1?"A linkage that appears now is seen when y\
ou let go.":"":""),say(this.gone,!answers.isOld&&answers.gone.length?`Not in the new answer: ${listed(answers.gone)} of the one before.`:""),this.element.classList.
toggle("bs-stale",answers.isOld)}statusText(){let{store,answers}=this,hidden=this.hidden?`${this.hidden} not shown by the filter. `:"";if(store.state==="offline")
return"The connection is gone; what you see is the last answer.";if(answers.isOld&&store.state==="dragging")return store.followed?"Moving along.":this.whenSolved();
if(store.state==="solving")return"Looking for all linkages.";if(!store.solved)return"";let{best,outcome}=store.solved;return store.solved.linkages.some(each2=>each2.
usable)?`${hidden}${best?.[0]??""}`:`${hidden}${sentence(outcome?.message)}${outcome?.help?` What helps: ${outcome.help}.`:""}`}whenSolved(){let{slow}=this.store;
if(slow===null)return"The new answer comes when you let go.";let took=`All linkages are looked for anew, which took ${slow<.95?"less than a second":`${Math.round(
slow)} s`} last time`;return slow>QUICK?`${took}: the new answer comes when you let go.`:`${took}: the answer lags behind your hand by so much.`}async improve(id){
let{document:document2,options,connection}=this.store,card=()=>[...this.cards].find(([linkage])=>linkage.id===id)?.[1];card()?.tellBetter(["Looking near it …"]);
let said;try{said=(await(await connection.post("/improve",{document:document2,options,linkage:id})).json()).better}catch(error){said=[`That did not work: ${error.
message}`]}document2===this.store.document&&card()?.tellBetter(said.length?said.map(nearIt):["Nothing better lies near it."])}walk(event){let step={ArrowDown:1,
ArrowRight:1,ArrowUp:-1,ArrowLeft:-1}[event.key],mains=[...this.cards.values()].map(card=>card.main),at=mains.indexOf(this.list.getRootNode().activeElement);!step||
at<0||(event.preventDefault(),mains[clamp(at+step,0,mains.length-1)].focus())}},nearIt=text=>text.replace(/^L\d+ changes/,"One changes"),sentence=text=>text?`${text[0].
toUpperCase()}${text.slice(1)}.`:"";var WIDTH=440,TURNING_SHARE=.35;function drawStill(canvas,scene,size2,turning){let share=turning?TURNING_SHARE:Math.min(1,WIDTH/size2.width),width=Math.round(size2.
width*share),height=Math.round(size2.height*share);if(canvas.width=width,canvas.height=height,!scene.quadrics.length)return;let context=canvas.getContext("2d");
if(!context)return;let image=context.createImageData(width,height);cast(image,scene),context.putImageData(image,0,0)}function cast(image,{eye,ahead,right,up,reach,
quadrics,paint,angles}){let{data,width,height}=image,[ex,ey,ez]=eye,[zc,zh,middleAngle,step]=angles,lamp=unit(plus(plus(scaled(ahead,-1),scaled(up,.5)),scaled(right,
-.6))),far=new Float64Array(4),which=new Uint8Array(4);for(let j=0;j<height;j+=1){let v=(1-(2*j+1)/height)*reach[1];for(let i=0;i<width;i+=1){let u=((2*i+1)/width-
1)*reach[0],dx=ahead[0]+u*right[0]+v*up[0],dy=ahead[1]+u*right[1]+v*up[1],dz=ahead[2]+u*right[2]+v*up[2],size2=1/Math.sqrt(dx*dx+dy*dy+dz*dz);dx*=size2,dy*=size2,
dz*=size2;let x1=(-1-ex)/dx,x2=(1-ex)/dx,y1=(-1-ey)/dy,y2=(1-ey)/dy,z1=(-1-ez)/dz,z2=(1-ez)/dz,enter=Math.max(Math.min(x1,x2),Math.min(y1,y2),Math.min(z1,z2)),leave=Math.
min(Math.max(x1,x2),Math.max(y1,y2),Math.max(z1,z2));if(!(enter<leave))continue;let middle2=(enter+leave)/2,half=(leave-enter)/2,ox=ex+middle2*dx,oy=ey+middle2*
dy,oz=ez+middle2*dz,count=0;for(let k=0;k<quadrics.length;k+=1){let c=quadrics[k],cx=c[0]*dx+c[1]*dy+c[2]*dz,cy=c[4]*dx+c[5]*dy+c[6]*dz,cz=c[8]*dx+c[9]*dy+c[10]*
dz,cw=c[12]*dx+c[13]*dy+c[14]*dz,a=dx*cx+dy*cy+dz*cz,b=ox*cx+oy*cy+oz*cz+cw,e=ox*(c[0]*ox+2*(c[1]*oy+c[2]*oz+c[3]))+oy*(c[5]*oy+2*(c[6]*oz+c[7]))+oz*(c[10]*oz+2*
c[11])+c[15],root=b*b-a*e;if(root<0)continue;let q=-(b+(b<0?-1:1)*Math.sqrt(root));for(let side=0;side<2;side+=1){let t=side?e/q:q/a;if(!(Math.abs(t)<=half))continue;
let at2=count;for(;at2>0&&far[at2-1]>t;)far[at2]=far[at2-1],which[at2]=which[at2-1],at2-=1;far[at2]=t,which[at2]=k,count+=1}}if(!count)continue;let red=0,green=0,
blue=0,through=1;for(let k=0;k<count;k+=1){let t=far[k],c=quadrics[which[k]],own=paint[which[k]],x=ox+t*dx,y=oy+t*dy,z=oz+t*dz,nx=c[0]*x+c[1]*y+c[2]*z+c[3],ny=c[4]*
x+c[5]*y+c[6]*z+c[7],nz=c[8]*x+c[9]*y+c[10]*z+c[11],n=1/Math.sqrt(nx*nx+ny*ny+nz*nz);nx*=n,ny*=n,nz*=n;let facing=Math.abs(nx*dx+ny*dy+nz*dz),pixels=(middle2+t)*
reach[1]/height*(Math.sqrt(Math.max(0,1-nz*nz))/Math.max(facing,.15))+1e-4,z3=zc+zh*z,turns=(2*Math.atan(z3)+middleAngle)/step,off=Math.abs(turns-Math.round(turns))*
step*(1+z3*z3)/(2*zh),line2=1-clamp((off/pixels-.5)/1.1,0,1),lit=(.42+.58*Math.abs(nx*lamp[0]+ny*lamp[1]+nz*lamp[2]))*(1-.35*line2),alpha=.5+.42*(1-facing)*(1-facing),
share=through*alpha;red+=share*own[0]*lit,green+=share*own[1]*lit,blue+=share*own[2]*lit,through*=1-alpha}let at=4*(j*width+i),whole=255/(1-through);data[at]=red*
whole,data[at+1]=green*whole,data[at+2]=blue*whole,data[at+3]=255*(1-through)}}}var UNIFORMS=["surface","paint","eye","right","up","ahead","reach","pixel","samples","angles"],VERTEX=`#version 300 es
in vec2 corner;
out vec2 at;
void main() { at = corner; gl_Position = vec4(corner, 0.0, 1.0); }`,FRAGMENT=`#version 300 es
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
}`;function hasGraphics(){let gl=document.createElement("canvas").getContext("webgl2",{failIfMajorPerformanceCaveat:!0}),named=gl?.getExtension("WEBGL_debug_ren\
derer_info"),name=gl&&named?gl.getParameter(named.UNMASKED_RENDERER_WEBGL):"";return!!gl&&!/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name)}var Shader=class _Shader{pace;static on(canvas,lost){
if(!hasGraphics())return null;let gl=canvas.getContext("webgl2",{antialias:!1,premultipliedAlpha:!0,preserveDrawingBuffer:!0});if(!gl)return null;let program=gl.
createProgram();for(let[kind,source]of[[gl.VERTEX_SHADER,VERTEX],[gl.FRAGMENT_SHADER,FRAGMENT]]){let shader=gl.createShader(kind);gl.shaderSource(shader,source),
gl.compileShader(shader),gl.attachShader(program,shader)}return gl.linkProgram(program),gl.getProgramParameter(program,gl.LINK_STATUS)?(canvas.addEventListener(
"webglcontextlost",lost,{once:!0}),new _Shader(canvas,gl,program)):(lost(),null)}constructor(canvas,gl,program){this.canvas=canvas,this.gl=gl,gl.useProgram(program),
gl.bindBuffer(gl.ARRAY_BUFFER,gl.createBuffer()),gl.bufferData(gl.ARRAY_BUFFER,new Float32Array([-1,-1,3,-1,-1,3]),gl.STATIC_DRAW);let corner=gl.getAttribLocation(
program,"corner");gl.enableVertexAttribArray(corner),gl.vertexAttribPointer(corner,2,gl.FLOAT,!1,0,0),this.places=Object.fromEntries(UNIFORMS.map(name=>[name,gl.
getUniformLocation(program,name)]))}draw(scene,size2,turning){let{gl,places}=this;if(gl.clearColor(0,0,0,0),!scene.quadrics.length){gl.clear(gl.COLOR_BUFFER_BIT);
return}gl.uniformMatrix4fv(places.surface,!1,new Float32Array(scene.quadrics.flat())),gl.uniform3fv(places.paint,new Float32Array(scene.paint.flat()));for(let name of[
"eye","right","up","ahead"])gl.uniform3fv(places[name],scene[name]);gl.uniform2fv(places.reach,scene.reach),gl.uniform4fv(places.angles,scene.angles),this.pace??=
this.measure(size2);let full=Math.min(2,window.devicePixelRatio||1),most=turning?25:250,ways=turning?[[1,1],[.7,1],[.45,1]]:[[full,4],[1,4],[full,1],[1,1],[.7,1]],
fits=ways.find(([dense,samples])=>dense*dense*samples*this.pace*size2.width*size2.height<most);this.once(size2,...fits??ways[ways.length-1])}measure(size2){let{
gl}=this;this.once(size2,.12,1),gl.finish();let start=performance.now();return this.once(size2,.3,1),gl.finish(),(performance.now()-start)/(.09*size2.width*size2.
height)}once(size2,dense,samples){let{gl,canvas,places}=this,width=Math.round(size2.width*dense),height=Math.round(size2.height*dense);(canvas.width!==width||canvas.
height!==height)&&(canvas.width=width,canvas.height=height),gl.viewport(0,0,width,height),gl.clear(gl.COLOR_BUFFER_BIT),gl.uniform2f(places.pixel,1/width,1/height),
gl.uniform1i(places.samples,samples),gl.drawArrays(gl.TRIANGLES,0,3)}};var FOCAL_LENGTH=2.3,EYE_DISTANCE=4.6,START={around:-.62,above:.38,zoom:1},MANY_POSES3=40,inside=point2=>point2.every(value=>Math.abs(value)<=1.0001),ImageSpace=class{waiting;space;marks;view;width;height;constructor(data,parent,webgl){
this.data=data,this.parent=parent,this.turn={...START},this.canvas=h("canvas",{"aria-hidden":"true"}),this.svg=s("svg",{"aria-hidden":"true"}),this.note=h("p",{
class:"bm-readout"}),this.box=h("div",{class:"bm-space",role:"img",tabindex:"0","aria-label":"Image space: two surfaces and the curve they meet in. Arrow keys t\
urn it, plus and minus zoom."},this.canvas,this.svg),parent.append(this.box,this.note),this.shader=webgl?Shader.on(this.canvas,()=>this.withoutGl()):null,this.explain(),
this.listen()}explain(){this.canvas.dataset.drawn=this.shader?"webgl":"still",this.note.textContent=this.shader?"Drag it, or turn it with the arrow keys; + and \
− zoom, 0 goes back.":"A still picture, for fast WebGL 2 is missing here; it can be turned all the same, by dragging or with the arrow keys."}withoutGl(){let fresh=this.
canvas.cloneNode();this.canvas.replaceWith(fresh),this.canvas=fresh,this.shader=null,this.explain(),this.space&&this.draw(!1)}listen(){let{box}=this,grip=null;box.
addEventListener("pointerdown",event=>{grip=[event.clientX,event.clientY],box.setPointerCapture(event.pointerId)}),box.addEventListener("pointermove",event=>{grip&&
(this.turn.around-=.008*(event.clientX-grip[0]),this.turn.above+=.008*(event.clientY-grip[1]),grip=[event.clientX,event.clientY],this.redraw(!0))});for(let end of[
"pointerup","pointercancel"])box.addEventListener(end,()=>{grip&&this.redraw(!1),grip=null});box.addEventListener("keydown",event=>{let{turn}=this,step={ArrowLeft:()=>turn.
around+=.1,ArrowRight:()=>turn.around-=.1,ArrowUp:()=>turn.above+=.1,ArrowDown:()=>turn.above-=.1,"+":()=>turn.zoom*=1.15,"=":()=>turn.zoom*=1.15,"-":()=>turn.zoom/=
1.15,0:()=>Object.assign(turn,START)}[event.key];!step||event.ctrlKey||event.metaKey||event.altKey||(event.preventDefault(),event.stopPropagation(),step(),this.
redraw(!1))})}redraw(turning){this.turn.above=clamp(this.turn.above,-1.5,1.5),this.turn.zoom=clamp(this.turn.zoom,.6,4),cancelAnimationFrame(this.waiting),this.
waiting=requestAnimationFrame(()=>this.draw(turning))}point(place){let{chart}=this.data,{centre,half}=this.space,x=(place.x-chart.origin[0])/chart.length,y=(place.
y-chart.origin[1])/chart.length,t=Math.tan((place.a-chart.angle)/2);return[(x*t-y)/2,(x+y*t)/2,t].map((value,k)=>(value-centre[k])/half[k])}build(linkage,index,quick=!1){
this.linkage=linkage,this.space=linkage?.space??this.data.space,this.poses=this.data.poses.map((pose,k)=>{let at=isPoint(pose)?linkage?.pose_errors[k]:pose;return at&&
at.x!==null?this.point({x:at.x,y:at.y,a:radians(at.angle_deg)}):null}),this.curves=(linkage?.ways??[]).map((way,k)=>({here:k===index,points:Array.from(way.x,(x,i)=>this.
point({x,y:way.y[i],a:way.angle[i]}))}));let{centre,half}=this.space,angleOf=q=>degrees(2*Math.atan(centre[2]+half[2]*q)+this.data.chart.angle);this.marks=angleTicks(
angleOf(-1),angleOf(1),7);let width=Math.max(240,this.parent.clientWidth);this.width=width,this.height=Math.round(clamp(.8*width,240,520)),this.svg.setAttribute(
"viewBox",`0 0 ${width} ${this.height}`),this.box.style.height=`${this.height}px`,this.draw(quick)}camera(){let{around:around3,above,zoom}=this.turn,ahead=[-Math.
cos(above)*Math.sin(around3),Math.cos(above)*Math.cos(around3),-Math.sin(above)],right=[Math.cos(around3),Math.sin(around3),0],up=cross2(right,ahead),eye=scaled(
ahead,-EYE_DISTANCE),focal=Math.min(this.width,this.height)/2*FOCAL_LENGTH*zoom*1.02;return{ahead,right,up,eye,focal,reach:[this.width/2/focal,this.height/2/focal]}}draw(turning){
this.view=this.camera();let scene=this.sceneOf(this.view);this.shader?this.shader.draw(scene,this,turning):drawStill(this.canvas,scene,this,turning),this.overlay(),
this.place&&this.show(this.place)}sceneOf(camera){let style=getComputedStyle(this.parent),paint=["--bm-driver-solid","--bm-follower-solid"].map(name=>rgb(style.
getPropertyValue(name)).map(v=>v/255));return{...camera,paint,quadrics:this.space.quadrics,angles:this.angles()}}angles(){let{centre,half}=this.space,{marks}=this,
step=marks.length>1?radians(marks[1].at-marks[0].at):Math.PI;return[centre[2],half[2],this.data.chart.angle,step]}project(point2){let{eye,ahead,right,up,focal}=this.
view,to=[0,1,2].map(k=>point2[k]-eye[k]),depth=dot(to,ahead);return[this.width/2+focal*dot(to,right)/depth,this.height/2-focal*dot(to,up)/depth]}sheetsBefore(point2){
let to=plus(this.view.eye,scaled(point2,-1)),d=unit(to),leave=1/0;for(let k=0;k<3;k+=1)leave=Math.min(leave,((d[k]>0?1:-1)-point2[k])/d[k]);let count=0;for(let c of this.
space.quadrics)for(let t of intersections(c,point2,d))t>.02&&t<leave&&(count+=1);return count}overlay(){let{svg}=this,back2=this.view.ahead.map(value=>value>0?1:
-1);svg.replaceChildren(...this.edges(back2),...this.axisNames(back2),...this.angleMarks(),...this.motions()),this.images(),this.runner=s("circle",{class:"bm-ru\
nner",r:6,visibility:"hidden"}),svg.append(this.runner)}edges(back2){let front="",behind="";for(let axis=0;axis<3;axis+=1)for(let[b,c]of[[-1,-1],[-1,1],[1,-1],[
1,1]]){let one=[0,0,0],[j,k]=[(axis+1)%3,(axis+2)%3];[one[j],one[k],one[axis]]=[b,c,-1];let other=[...one];other[axis]=1;let d=`M${this.project(one).map(px).join(
" ")}L${this.project(other).map(px).join(" ")}`;b===back2[j]&&c===back2[k]?behind+=d:front+=d}return[s("path",{class:"bm-box bm-behind",d:behind}),s("path",{class:"\
bm-box",d:front})]}axisNames(back2){let name=(point2,text)=>{let[x,y]=this.project(point2),[cx,cy]=[x-this.width/2,y-this.height/2],size2=Math.hypot(cx,cy)||1;return s(
"text",{class:"bm-axis",x:px(x+14*cx/size2),y:px(y+14*cy/size2+4),"text-anchor":"middle"},text)},base=this.turn.above>=0?-1:1;return[name([0,-back2[1],base],"Z1"),
name([-back2[0],0,base],"Z2")]}angleMarks(){let edge=[[-1,-1],[-1,1],[1,-1],[1,1]].map(([a,b])=>({a,b,x:this.project([a,b,0])[0]})).reduce((one,other)=>other.x<
one.x?other:one),{centre,half}=this.space;return this.marks.flatMap(({at,text})=>{let t=Math.tan((radians(at)-this.data.chart.angle)/2),q=(t-centre[2])/half[2],
[x,y]=this.project([edge.a,edge.b,q]);return[s("path",{class:"bm-box",d:`M${px(x)} ${px(y)}h-5`}),s("text",{class:"bm-axis",x:px(x-8),y:px(y+4),"text-anchor":"e\
nd"},text)]})}motions(){return this.curves.flatMap(({here,points})=>{let paths=["",""],last=null;for(let k=0;k<points.length;k+=1){let p=points[k];if((!inside(p)||
k&&Math.hypot(...plus(p,scaled(points[k-1],-1)))>.6)&&(last=null),!inside(p))continue;let at=this.project(p),hidden=this.sheetsBefore(p)>0?1:0;last&&(paths[hidden]+=
`M${last.map(px).join(" ")}L${at.map(px).join(" ")}`),last=at}let kind=here?"bm-here":"bm-other";return[s("path",{class:`bm-motion bm-hidden ${kind}`,d:paths[1]}),
s("path",{class:`bm-motion ${kind}`,d:paths[0]})]})}images(){let{svg,data}=this,labels=new Labels({width:this.width,height:this.height}),shown2=this.poses.map((point2,k)=>({
point:point2,k})).filter(({point:point2})=>point2&&inside(point2));for(let{point:point2}of shown2){let[x,y]=this.project(point2);labels.block(x,y,10,10)}for(let{
point:point2,k}of shown2){let[x,y]=this.project(point2),hidden=this.sheetsBefore(point2)>0;svg.append(s("circle",{class:`bm-image-point${hidden?" bm-hidden":""}`,
cx:px(x),cy:px(y),r:4})),shown2.length<=MANY_POSES3&&isNamed(data,k)&&svg.append(labels.put(x,y,data.poses[k].label,12,{class:"bm-image-name"}))}}hide(){this.place=
null,this.runner.setAttribute("visibility","hidden")}show(place){this.place=place;let point2=this.point(place),inside2=point2.every(value=>Math.abs(value)<=1.02);
if(this.runner.setAttribute("visibility",inside2?"visible":"hidden"),!inside2)return;let[x,y]=this.project(point2);this.runner.setAttribute("transform",`transla\
te(${px(x)} ${px(y)})`)}};function coefficients(dyad,{origin,angle,length}){let c=Math.cos(angle),d=Math.sin(angle),hand=dyad.moving_pivot&&[(c*dyad.moving_pivot[0]-d*dyad.moving_pivot[1])/
length,(d*dyad.moving_pivot[0]+c*dyad.moving_pivot[1])/length],foot2=dyad.fixed_pivot&&dyad.fixed_pivot.map((value,k)=>(value-origin[k])/length);if(dyad.kind===
"RR"){let[x,y]=hand,[xc,yc]=foot2,squared=(dyad.radius/length)**2/4,s1=-(x+xc)/2,s2=-(y+yc)/2,t1=-(y-yc)/2,t2=(x-xc)/2;return[1,s1*s1+s2*s2-squared,2*s1,2*s2,2*
t1,2*t2,2*(s1*t1+s2*t2),t1*t1+t2*t2-squared]}let normal=radians(dyad.line.normal_deg);if(dyad.kind==="PR"){let n=[Math.cos(normal),Math.sin(normal)];return line(
normal,(dyad.line.offset-n[0]*origin[0]-n[1]*origin[1])/length,hand)}return line(normal+angle,dyad.line.offset/length,foot2).map((value,k)=>k>=4&&k<7?-value:value)}
function line(normal,offset,[x,y]){let n1=Math.cos(normal),n2=Math.sin(normal),along2=n1*x+n2*y,across=n2*x-n1*y;return[0,-along2-offset,2*n1,2*n2,-2*n2,2*n1,2*
across,along2-offset]}function matrixOf(dyad,chart){if(dyad.kind==="PP"){let half=(radians(dyad.angle_deg)-chart.angle)/2;return[0,0,0,0,0,0,0,0,0,0,0,Math.cos(
half)/2,0,0,Math.cos(half)/2,-Math.sin(half)]}let[p1,p2,p3,p4,p5,p6,p7,p8]=coefficients(dyad,chart);return[p1,0,p3/2,p5/2,0,p1,p4/2,p6/2,p3/2,p4/2,p2,p7/2,p5/2,
p6/2,p7/2,p8]}function quadricOf(dyad,chart,{centre,half}){let c=matrixOf(dyad,chart),to=(r,k)=>r===k?k<3?half[k]:1:k===3?centre[r]:0,out=new Array(16).fill(0);
for(let i=0;i<4;i+=1)for(let j=0;j<4;j+=1)for(let r=0;r<4;r+=1)for(let k=0;k<4;k+=1)out[4*i+j]+=to(r,i)*c[4*r+k]*to(k,j);let greatest=Math.max(...out.map(Math.abs));
return out.map(value=>value/greatest)}var CALM=200,SpacePanel=class{constructor(answers,playing){this.answers=answers,this.playing=playing,this.story=h("p",{class:"bm-story"});let fill=h("div",{class:"\
bm-fill"});this.element=h("div",{},this.story,fill),this.fill=fill,this.space=new ImageSpace(answers.data,fill,!0),this.quick=new Pace(()=>this.build(!0),()=>isSeen(
fill)),playing.on("shape",()=>this.ask()),answers.on("poses placed",()=>this.ask()),playing.on("place",({place})=>{this.space.view&&!answers.isOld&&isSeen(fill)&&
this.space.show(place)}),new ResizeObserver(()=>this.ask()).observe(fill),watch(fill,()=>this.ask())}ask(){this.quick.ask(),clearTimeout(this.calm),this.calm=setTimeout(
()=>isSeen(this.fill)&&this.build(!1),CALM)}get dyads(){let{linkage}=this.playing,{placed}=this.answers.store;return!linkage&&placed?.dyads?.length?placed.dyads:
linkage?.led??[]}build(quick){let{answers,playing,space,dyads}=this,{data}=answers,{linkage}=playing;if(!data.poses.length)return;let box=linkage?.space??data.space,
quadrics=dyads.map(dyad=>quadricOf(dyad,data.chart,box));quadrics.length===1&&quadrics.push(quadrics[0]);let shown2={...linkage&&!linkage.gone?linkage:{ways:[],
led:dyads},space:{...box,quadrics}},key=dyads.map(dyad=>dyad.id).join();key!==this.told&&(this.told=key,this.story.replaceChildren(...spaceStory(data,linkage&&dyads.
length===2?{id:linkage.id,led:dyads}:null))),space.build(shown2,playing.player.way,quick),playing.path&&playing.here?space.show(playing.here.place):space.hide()}};var LOADS=["loads","springs","drive"];function addResults(store,scene,{player,results,drawer}){let answers=new Answers(store),playing=new Playing(store,answers),
live=new LiveLinkage(answers,playing,scene),surface=new PivotSurface(store,answers,playing,scene),centrodes=new Centrodes(answers,playing,scene),curves=new CouplerCurves(
answers,playing,scene),dimensions=new Dimensions(store,scene,playing,answers),cards=new Results(store,answers),charts=new Charts(answers,playing),space=new SpacePanel(
answers,playing),cognates=new CognatePanel(store,answers),loads=new LoadCharts(answers,playing),compare=new Compare(store,answers,playing,()=>drawer.open("compa\
re")),facts=new FactsTable(store,answers,playing,curves),ways=[...playing.element.querySelectorAll(".bs-player-ways, .bs-driver-note")];player.append(playing.element),
results.append(cards.element);let ofAngles=()=>!store.document.poses.some(isPoint2);return drawer.add("charts","Errors and transmission",charts.element),drawer.
add("loads","Loads",loads.element,()=>LOADS.some(key=>store.document[key])),drawer.add("motion","Driver and curves",h("div",{},ways,h("div",{class:"bs-player-to\
ols"},centrodes.element,curves.element))),drawer.add("cognates","Cognates",cognates.element,()=>isOfPoints(store.document)),drawer.add("pivots","Pivots",surface.
element,ofAngles),drawer.add("space","Image space",space.element,ofAngles),drawer.add("compare","Compare",compare.element),drawer.add("facts","Tables",facts.element),
store.on("document",()=>drawer.update()),drawer.update(),unfoldForPrint(drawer.element,new AbortController().signal),catchUpForPrint(),listenToSpace(playing),playOnce(
store,answers,playing),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>answers.emit("answers")),{dimensions,answers,playing,live,surface,
centrodes,curves,cards,charts,loads,space,cognates,compare,facts}}var FEW2=40,PointFields=class{constructor({name,options,step,set}){this.name=name,this.options=options,this.step=step,this.set=set,this.fields=[],this.shape=h("\
span",{class:"bs-hint"}),this.more=h("p",{class:"bs-hint"}),this.pairs=h("div",{class:"bs-coordinates"}),this.element=h("div",{class:"bs-point-fields"},this.shape,
this.pairs,this.more)}show(shape,points){let count=Math.min(points.length,FEW2);for(shape!==this.shape.textContent&&(this.fields=[]),say(this.shape,shape);this.
fields.length<count;)this.fields.push(this.make(this.fields.length));this.fields.length=count;let wanted=this.fields.map(each2=>each2.element);(wanted.length!==
this.pairs.children.length||wanted.some((each2,k)=>each2!==this.pairs.children[k]))&&this.pairs.replaceChildren(...wanted),this.fields.forEach(({pair},k)=>pair.
forEach((field,i)=>field.show(points[k][i]))),give(this.more,"hidden",points.length<=FEW2),say(this.more,`and ${points.length-FEW2} more, to drag in the plane`)}make(k){
let pair=["x","y"].map((axis,i)=>new NumberField({label:`${axis} of point ${k+1} of ${this.name}`,options:()=>({...this.options(),optional:!1}),step:this.step,commit:value=>this.
set(points=>points.map((point2,j)=>j===k?point2.map((old,m)=>m===i?value:old):point2))}));return{pair,element:h("span",{class:"bs-pair"},pair.map(field=>field.element))}}};var SHAPES=["point","line","segment","box","polygon"],SIGMA=[["position","position","length"],["angle_deg","angle","angle"]],MOST_NAMES2=200,UNITS2=["","mm","cm",
"m","in","ft"],section=(name,title,open,...content)=>h("details",{class:"bs-section","data-section":name,open},h("summary",{},title),...content),TaskPanel=class{madeTables;regionRows;linkWidth;margin;inPlane;bodyNumbers;asks;options;tables;apart;regionList;sigma;constructor(store,scene,regions,body,files,form){
this.store=store,this.scene=scene,this.regions=regions,this.body=body,this.files=files,this.form=form,this.element=h("div",{class:"bs-task"}),this.element.append(
this.makeRequirements(),this.makeLimits(),this.makeRegions(),this.makeBody(),this.makeSigma(),this.makeOptions()),store.on("document selection reference",()=>this.
draw()),regions.onjudged=()=>this.drawVerdicts(),this.draw()}edit(change){this.store.edit(change)}length(label,commit,options={},attributes={}){return new NumberField(
{label,commit,options:()=>({kind:"length",unit:this.store.document.length_unit,optional:!0,...options}),step:()=>this.scene.step,attributes})}tools(label,shapes,toolOf,data){
return h("div",{class:"bs-tools",role:"group","aria-label":label},shapes.map(shape=>this.toolButton(shape,()=>toolOf(shape),{"data-draw":`${data} ${shape}`})))}toolButton(text,toolOf,attributes){
let made2=button(text,()=>this.scene.use(made2.tool&&made2.tool===this.scene.tool?null:made2.tool=toolOf()),{"aria-pressed":"false",...attributes});return this.
scene.on("tool",tool=>put(made2,"aria-pressed",!!tool&&tool===made2.tool)),made2}points(name,set){return new PointFields({name,set,options:()=>({kind:"length",unit:this.
store.document.length_unit}),step:()=>this.scene.step})}makeLimits(){return this.apart=tick("another limit for each of the two dyads",on=>this.edit(document2=>splitLimits(
document2,on)),{"data-key":"limits-apart"}),this.tables=h("div",{}),this.madeTables=[],section("limits","Limits of pivots and links",!1,this.apart.element,this.
tables)}limitsOf(form){return this.form.limits.filter(each2=>each2.form===form)}makeTable(k){let{store,regions}=this,edit=changes=>this.edit(document2=>setLimit(
document2,k,changes)),title=h("h3",{}),parts={};for(let{key,label:name}of this.limitsOf("region")){let state=h("p",{class:"bs-state"}),numbers=this.points(`the \
limit of the ${key.replace("_"," ")}`,change=>this.edit(document2=>withPoints(document2,k,key,change))),remove=button("Delete",()=>regions.removeLimit(k,key),{"\
data-do":`delete-limit-${k}-${key}`,"aria-label":`Delete the limit: ${name}`});parts[key]={state,numbers,remove},parts[key].element=h("div",{class:"bs-limit-box"},
h("h4",{},name),this.tools(`Draw a limit: ${name}`,SHAPES,shape=>regions.limitTool(k,key,shape),`limit ${k} ${key}`),numbers.element,state,remove)}let least2=this.
length("least length",value=>edit({length:range(value,limitsOf(store.document)[k]?.length?.most)}),{least:0},{"data-key":`least-${k}`,placeholder:"any"}),most=this.
length("greatest length",value=>edit({length:range(limitsOf(store.document)[k]?.length?.least,value)}),{least:0},{"data-key":`most-${k}`,placeholder:"any"}),[{label,
choices}]=this.limitsOf("kinds"),kinds=choices.map(([kind,text])=>({kind,...tick(`${kind}: ${text}`,()=>edit({kinds:kindsOf2(kinds)}),{"data-key":`kind-${k}-${kind}`})})),
lengthState=h("p",{class:"bs-state"}),kindsState=h("p",{class:"bs-state"});return{element:h("div",{class:"bs-limit-table"},title,Object.values(parts).map(part=>part.
element),h("div",{class:"bs-row"},labelled("length from",least2.element),labelled("to",most.element)),lengthState,h("div",{class:"bs-row",role:"group","aria-lab\
el":label},kinds.map(each2=>each2.element)),kindsState),title,parts,least:least2,most,kinds,lengthState,kindsState}}drawLimits(){let{document:document2}=this.store,
tables=limitsOf(document2),count=Math.max(1,tables.length);for(give(this.apart.box,"checked",tables.length>1);this.madeTables.length<count;)this.madeTables.push(
this.makeTable(this.madeTables.length));for(;this.tables.children.length>count;)this.tables.lastChild.remove();for(;this.tables.children.length<count;)this.tables.
append(this.madeTables[this.tables.children.length].element);for(let k=0;k<count;k+=1){let table3=tables[k]??{},made2=this.madeTables[k];say(made2.title,count>1?
`Dyad ${k+1}`:"Both dyads");for(let key of Object.keys(made2.parts))this.drawLimit(made2.parts[key],table3[key]);made2.least.show(table3.length?.least),made2.most.
show(table3.length?.most);for(let{kind,box}of made2.kinds)box.checked=!table3.kinds||table3.kinds.includes(kind)}}drawLimit({numbers,remove},region){for(let each2 of[
remove,numbers.element])give(each2,"hidden",!region);if(!region)return;let[[shape,stated]]=Object.entries(region);numbers.show(shape,shape==="point"?[stated]:stated)}drawVerdicts(){
let{regions}=this,tables=limitsOf(this.store.document);this.madeTables.forEach((made2,k)=>{for(let key of Object.keys(made2.parts))tell(made2.parts[key].state,tables[k]?.[key]?
regions.said(k,key):null);tell(made2.lengthState,tables[k]?.length?regions.said(k,"length"):null),tell(made2.kindsState,tables[k]?.kinds?regions.said(k,"kinds"):
null)}),this.regionRows.forEach((row,k)=>tell(row.state,regions.touched?[regions.touched[k]].filter(Boolean):null))}makeRegions(){return this.regionList=h("div",
{}),this.regionRows=[],this.linkWidth=this.length("width of the links",value=>this.edit(document2=>setSurrounding(document2,"link_width",value)),{least:0},{"dat\
a-key":"link_width",placeholder:"0"}),this.margin=this.length("least clearance",value=>this.edit(document2=>setSurrounding(document2,"margin",value)),{least:0},
{"data-key":"margin",placeholder:"0"}),this.inPlane=tick("links that stand on the ground must not touch the body either",on=>this.edit(document2=>setSurrounding(
document2,"body_in_plane",on||void 0)),{"data-key":"body_in_plane"}),section("keep-out","Regions to keep out of",!1,h("p",{class:"bs-hint"},"The body and the li\
nks must not touch them between the poses."),this.tools("Draw a region to keep out of",["box","polygon"],shape=>this.regions.regionTool(shape),"region"),this.regionList,
h("div",{class:"bs-row"},labelled("links are wide",this.linkWidth.element),labelled("least clearance",this.margin.element)),this.inPlane.element)}drawRegions(){
let{store}=this,regions=regionsOf(store.document);for(;this.regionRows.length<regions.length;)this.regionRows.push(this.regionRow(this.regionRows.length)),this.
regionList.append(this.regionRows.at(-1).element);for(let row of this.regionRows.splice(regions.length))row.element.remove();this.regionRows.forEach((row,k)=>row.
show(regions[k],store.selection?.kind==="region"&&store.selection.index===k));let{link_width,margin,body_in_plane}=store.document.surroundings??{};this.linkWidth.
show(link_width),this.margin.show(margin),give(this.inPlane.box,"checked",!!body_in_plane)}regionRow(k){let{store}=this,shapeKey=region=>region.box?"box":"polyg\
on",name=textField(`Name of region ${k+1}`,text=>this.edit(document2=>setRegion(document2,k,{name:text.trim()||void 0})),{"data-key":`region-name-${k}`,placeholder:`\
region ${k+1}`}),numbers=this.points(`region ${k+1}`,change=>this.edit(document2=>{let region=regionsOf(document2)[k],key=shapeKey(region);return setRegion(document2,
k,{[key]:change(region[key])})})),state=h("p",{class:"bs-state"}),inNumbers=h("details",{},h("summary",{},"in numbers"),numbers.element),file=h("p",{class:"bs-h\
int"}),element=h("div",{class:"bs-limit-box","data-region-row":k,onfocusin:()=>store.select({kind:"region",index:k})},h("div",{class:"bs-row"},name,button("Dele\
te",()=>this.regions.removeRegion(k),{"data-do":`delete-region-${k}`,"aria-label":`Delete region ${k+1}`})),state,inNumbers,file);return{element,state,show:(region,selected)=>{
let text=(region.name??"").replace(/[\r\n]+/g," ");document.activeElement!==name&&name.value!==text&&(name.value=text),element.classList.toggle("bs-selected",selected),
give(inNumbers,"hidden",region.file!==void 0),give(file,"hidden",!inNumbers.hidden),inNumbers.hidden?file.textContent=`from the drawing ${region.file}`:numbers.
show(shapeKey(region),region[shapeKey(region)])}}}makeBody(){return this.bodyNumbers=this.points("the outline",change=>this.edit(document2=>setBody(document2,change(
bodyOf(document2))))),this.bodyCount=h("summary",{}),this.bodyBox=h("details",{},this.bodyCount,this.bodyNumbers.element),this.reference=choice("Draw at",[],value=>this.
store.setReference(Number(value)),{"data-key":"reference"}),this.noBody=button("Delete the outline",()=>this.edit(document2=>setBody(document2,[])),{"data-do":"\
delete-body"}),section("body","Outline of the body",!1,h("p",{class:"bs-hint"},"It is seen at every pose, moves with the linkage, and says what an angle error c\
ounts as."),labelled("draw what belongs to the body at pose",this.reference),h("div",{class:"bs-tools"},this.toolButton("Draw it",()=>this.body.tool(),{"data-dr\
aw":"body"}),button("From a drawing (SVG, DXF)…",()=>this.files.chooseOutline(),{"data-do":"outline-file"}),this.noBody),this.bodyBox)}drawBody(){let{document:task,
referenceIndex}=this.store,corners=bodyOf(task),names=task.poses.slice(0,MOST_NAMES2).map((_,k)=>poseName2(task,k));names.join(`
`)!==this.poseNames&&this.reference.replaceChildren(...names.map((name,k)=>h("option",{value:k},name))),this.poseNames=names.join(`
`),this.reference.value=String(referenceIndex),give(this.noBody,"hidden",!task.body),give(this.bodyBox,"hidden",!corners.length),corners.length&&(say(this.bodyCount,
`${corners.length} corners, in numbers`),this.bodyNumbers.show("polygon",corners))}makeRequirements(){this.asks=this.form.requirements.map(each2=>({...each2,...this.
field(each2,value=>this.edit(document2=>setRequirement(document2,each2.key,value)))}));let of=(...forms)=>this.asks.filter(({form})=>forms.includes(form)).map(({
element})=>element);return section("requirements","What the linkage must be",!0,h("div",{class:"bs-grid"},of("number","corridor"),of("choice")),of("flag"),of("a\
rea"),of("names"))}field({key,label,form,choices,...bounds2},set){let attributes={"data-key":key};switch(form){case"choice":case"word":{let[[usual]]=choices,element=choice(
label,choices,value=>set(value===usual?void 0:value),attributes);return{element:labelled(label,element),show:value=>element.value=value??usual}}case"flag":{let{
box,element}=tick(label,on=>set(on||void 0),attributes);return{element,show:value=>give(box,"checked",!!value)}}case"names":{let ticks2=choices.map(([name,text])=>({
name,...tick(text,()=>set(some(ticks2)),{"data-key":`${key}-${name}`})}));return{element:h("details",{},h("summary",{},label),h("div",{class:"bs-ticks"},ticks2.
map(each2=>each2.element)),h("p",{class:"bs-hint"},"None: any.")),show:value=>ticks2.forEach(({name,box})=>box.checked=!!value?.includes(name))}}case"corridor":{
let side=name=>new NumberField({label:`${label}, ${name}`,commit:()=>least2.value!==void 0&&greatest.value===void 0?void 0:set(both()),options:()=>({optional:!0,
kind:"number"}),attributes:{"data-key":`${key}-${name}`,placeholder:"–"}}),least2=side("least"),greatest=side("greatest"),both=()=>greatest.value===void 0?void 0:
least2.value===void 0?greatest.value:[least2.value,greatest.value];return{element:labelled(label,h("span",{class:"bs-pair"},least2.element,greatest.element)," "),
show:value=>[least2,greatest].forEach((field,k)=>field.show(Array.isArray(value)?value[k]:k?value:void 0))}}case"area":{let none=button("Delete",()=>set(void 0),
{"data-do":`delete-${key}`,"aria-label":`Delete the ${key}`});return{element:h("div",{class:"bs-limit-box"},h("h4",{},label),this.tools(`Draw the ${key}`,["box",
"polygon"],shape=>this.regions.footprintTool(shape),key),none),show:value=>give(none,"hidden",!value)}}default:{let options=form==="length"?{kind:"length",above:0}:
bounds2,field=new NumberField({label,commit:set,options:()=>({optional:!0,unit:this.store.document.length_unit,...options}),step:()=>form==="length"?this.scene.
step:1,attributes:{...attributes,placeholder:"–"}});return{element:labelled(label,field.element,options.kind==="angle"?"°":" "),show:value=>field.show(value)}}}}drawRequirements(){
let{requirements,loads,springs,drive}=this.store.document,loaded=!!(loads??springs??drive);for(let{key,show,element,loads:ofLoads}of this.asks)show(requirements?.[key]),
give(element,"hidden",!!ofLoads&&!loaded&&requirements?.[key]===void 0)}makeOptions(){let{store}=this;this.unit=choice("unit of length",UNITS2.map(unit2=>[unit2,
unit2||"not stated"]),value=>this.edit(document2=>withKeys(document2,{length_unit:value||void 0})),{"data-key":"length_unit"}),this.options=this.form.options.map(
each2=>({...each2,...this.field(each2,value=>store.option(each2.key,value))}));let of=form=>this.options.filter(each2=>each2.form===form).map(({element})=>element);
return section("options","Unit and method",!1,h("div",{class:"bs-grid"},labelled("unit of length",this.unit),of("word"),of("length")),h("p",{class:"bs-hint"},"A\
nother unit leaves the numbers as they are."))}drawOptions(){let{document:document2,options}=this.store,unit2=document2.length_unit??"";[...this.unit.options].some(
each2=>each2.value===unit2)||this.unit.append(h("option",{value:unit2},unit2)),this.unit.value=unit2;for(let{key,show}of this.options)show(options[key])}makeSigma(){
let{store,scene}=this;return this.wanted={},this.lack=h("p",{class:"bs-fault",hidden:!0},"Give both: how far positions are off, and how far angles."),this.sigma=
SIGMA.map(([key,name,kind])=>{let field=new NumberField({label:`standard deviation of the ${name}`,options:()=>({kind,unit:store.document.length_unit,optional:!0,
above:0}),step:()=>kind==="angle"?.1:scene.step/10,commit:value=>this.setSigma(key,value),attributes:{"data-key":`sigma-${key}`,placeholder:"–"}});return{key,
name,field}}),section("sigma","How well the poses are known",!1,h("p",{class:"bs-hint"},"Standard deviations of what was measured. Left empty: as well as their \
digits say."),h("div",{class:"bs-grid"},this.sigma.map(({name,field})=>labelled(`${name} ±`,field.element,name==="angle"?"°":" "))),this.lack)}setSigma(key,value){
this.wanted=withKeys({...this.store.document.pose_sigma,...this.wanted},{[key]:value});let given=Object.keys(this.wanted).length;if(give(this.lack,"hidden",given!==
1),given===1)return;let pose_sigma=given?this.wanted:void 0;this.wanted={},this.store.edit(document2=>withKeys(document2,{pose_sigma}))}drawSigma(){let{pose_sigma}=this.
store.document;this.wanted={},give(this.lack,"hidden",!0);for(let{key,field}of this.sigma)field.show(pose_sigma?.[key])}draw(){let{document:{limits,keep_out,surroundings,
body,requirements,length_unit,pose_sigma,poses},options,selection,reference}=this.store,now=[limits,keep_out,surroundings,body,requirements,length_unit,pose_sigma,
options,selection,reference,poses.length];now.every((each2,k)=>each2===this.drawn?.[k])&&this.drawn||((!this.drawn||pose_sigma!==this.drawn[6])&&this.drawSigma(),
this.drawn=now,this.drawLimits(),this.drawRegions(),this.drawBody(),this.drawRequirements(),this.drawOptions(),this.drawVerdicts())}};function tell(element,sentences){
give(element,"hidden",sentences===null),sentences!==null&&(put(element,"class",`bs-state ${sentences.length?"bs-broken":"bs-met"}`),say(element,sentences.length?
`✕ ${sentences.join(" ")}`:"✓ met by the chosen linkage"))}function withPoints(document2,k,key,change){let[[shape,stated]]=Object.entries(limitsOf(document2)[k][key]);
return setLimit(document2,k,{[key]:shapeOf(shape,change(shape==="point"?[stated]:stated))})}var range=(least2,most)=>least2===void 0&&most===void 0?void 0:{...least2===
void 0?{}:{least:least2},...most===void 0?{}:{most}};function kindsOf2(kinds){let list=kinds.filter(({box})=>box.checked).map(({kind})=>kind);return list.length===
kinds.length||!list.length?void 0:list}function some(ticks2){let list=ticks2.filter(({box})=>box.checked).map(({name})=>name);return list.length?list:void 0}var TransformPanel=class{constructor(store,scene,lengths){this.store=store,this.scene=scene,this.lengths=lengths;let field=(label,kind,value,name,bounds2={})=>{
let made2=new NumberField({label,commit:()=>{},options:()=>({kind,unit:store.document.length_unit,...bounds2}),step:()=>kind==="length"?scene.step:kind==="angle"?
1:.1,attributes:{"data-key":name}});return made2.show(value),made2},x=field("to the right","length",0,"move-x"),y=field("up","length",0,"move-y"),turn=field("tu\
rn by","angle",90,"turn-by"),scale=field("scale by","number",2,"scale-by",{above:0}),act2=(text,by,name)=>button(text,()=>[x,y,turn,scale].every(each2=>each2.fault.
hidden)&&this.apply(by()),{"data-do":name}),still={turn:0,scale:1,mirror:!1};this.what=choice("What is moved",[["task","the whole task"],["poses","the selected \
poses"]],()=>this.draw(),{"data-key":"move-what"}),this.point=choice("The point that stays",[],()=>{},{"data-key":"move-about"}),this.fault=h("p",{class:"bs-fau\
lt",hidden:!0,role:"alert"}),this.element=h("details",{class:"bs-section","data-section":"transform",ontoggle:()=>this.draw()},h("summary",{},"Move, turn, mirro\
r, scale"),h("p",{class:"bs-hint"},"All conditions go along: limits, outline, surroundings, loads. Forces, masses and times stay."),this.what,h("div",{class:"bs\
-row"},labelled("right",x.element),labelled("up",y.element),act2("Move",()=>({...still,x:x.value,y:y.value}),"move-by")),labelled("about",this.point),h("div",{class:"\
bs-row"},labelled("by °",turn.element),act2("Turn",()=>this.about({turn:turn.value}),"turn-by")),h("div",{class:"bs-row"},labelled("by",scale.element),act2("Sc\
ale",()=>this.about({scale:scale.value}),"scale-by")),h("div",{class:"bs-row"},act2("Mirror left to right",()=>this.about({turn:180,mirror:!0}),"mirror-x"),act2(
"Mirror upside down",()=>this.about({mirror:!0}),"mirror-y")),h("div",{class:"bs-row"},act2("Bring that point to 0, 0",()=>({...still,x:-this.at[0],y:-this.at[1]}),
"to-origin")),this.fault),store.on("document selection solved chosen",()=>this.draw())}about(by){return about(this.at,by)}get points(){let{store}=this,{document:document2,
selectedPoses}=this.store;return[["the origin of the ground",[0,0]],["the middle of the poses",middleOfPoses(document2)],...selectedPoses.slice(0,1).map(k=>[`po\
se ${poseName2(document2,k)}`,Object.values(standing(document2,k)).slice(0,2)]),...(currentLinkage(store)?.led??[]).filter(dyad=>dyad.fixed_pivot).map(dyad=>[`t\
he fixed pivot of ${dyad.id}`,dyad.fixed_pivot])]}get at(){let{points}=this;return(points.find(([name])=>name===this.point.value)??points[0])[1]}draw(){if(!this.
element.open)return;let names=this.points.map(([name])=>name),before=this.point.value;names.join()!==[...this.point.options].map(each2=>each2.value).join()&&this.
point.replaceChildren(...names.map(name=>h("option",{value:name},name))),names.includes(before)&&(this.point.value=before),give(this.what.options[1],"disabled",
!this.store.selectedPoses.length),this.store.selectedPoses.length||(this.what.value="task")}apply(by){let{store}=this,{document:document2,selectedPoses,options}=store,
indices=this.what.value==="poses"?selectedPoses:[...document2.poses.keys()],fault=aslant({...document2,poses:document2.poses.filter((_,k)=>indices.includes(k))},
by);if(give(this.fault,"hidden",!fault),say(this.fault,fault),fault)return;if(this.what.value==="poses")return void store.edit(now=>withPosesMoved(now,indices,by)??
now);let hasMoreDigits=by.scale!==1||by.turn%90!==0,sigma=document2.pose_sigma??(hasMoreDigits?store.solved?.pose_sigma:void 0),scaled2=Object.entries(options).
map(([key,value])=>[key,this.lengths.includes(key)?by.scale*value:value]);store.edit(now=>transformed(now,by,sigma),{options:Object.fromEntries(scaled2),picture:store.
picture&&{...store.picture,place:composed(by,store.picture.place)}}),this.scene.fit()}};var EMPTY="An empty task: add poses or points here, draw a path, paste rows of a spreadsheet, drop a file, or take a template.",CURVE="Drag a point of the curve\
, or draw another one: the linkages are looked for anew.",POINTS2="Drag a pose or a point: the linkages are looked for anew.",PATIENCE=700,FIRST="Drag a pose by\
 its point, turn it by the tip of its arrow: every linkage answers at once.";function layOut(root,store,start){let scene=new Scene(store),banners=new Banners(store),
files=new Files(store,start,banners);banners.files=files;let body=new BodyEditor(store,scene),regions=new Regions(store,scene),settings=new ExportSettings(store,
scene,start.exports??[],files),panel=new TaskPanel(store,scene,regions,body,files,start.form),handles=new PoseHandles(store,scene),table3=new PoseTable(store,scene),
curve=new PathCurve(store,scene),path2=new PathPanel(store,scene),player=h("div",{id:"bs-player"}),cards=h("div",{id:"bs-results"}),drawer=new Drawer,poses=h("d\
etails",{class:"bs-section bs-section-poses","data-section":"poses",open:!0},h("summary",{},"Poses"),table3.element,path2.element),left=sidePanel("left","The ta\
sk",h("div",{class:"bs-left"},poses,panel.element,new TransformPanel(store,scene,start.form.options.filter(({form})=>form==="length").map(({key})=>key)).element)),
right=sidePanel("right","Linkages",cards);root.replaceChildren(h("a",{class:"bs-skip",href:"#plane",onclick:event=>(event.preventDefault(),scene.svg.focus())},"\
Skip to the plane"),head(store,files,settings,banners,keyList()),banners.element,h("main",{class:"bs-main"},left,h("section",{class:"bs-stage",id:"plane","aria-\
label":"The plane"},stageBar(store,scene,()=>files.opened()),h("div",{class:"bs-canvas"},scene.element,planeLine(store,scene)),player),sheets(root,[["task","Tas\
k",left],["linkages","Linkages",right],["drawer","Charts",drawer.element]]),right,drawer.element)),scene.resize();let{dimensions}=addResults(store,scene,{player,
results:cards,drawer});return root.querySelector(".bs-bar")?.append(dimensions.element),listenToKeys(store,scene,files),new Autosave(store),files.opened=refitWhenSolved(
store,scene),{scene,banners,files,body,regions,panel,handles,table:table3,curve,path:path2}}function head(store,files,settings,banners,keys){let name=h("input",
{class:"bs-text bs-task-name","aria-label":"Name of the task",autocomplete:"off",spellcheck:"false",onchange:()=>store.rename(name.value.trim()||"task")}),undo=button(
"↶",()=>store.undo(),{"data-do":"undo",title:"Undo (Ctrl+Z)","aria-label":"Undo"}),redo=button("↷",()=>store.redo(),{"data-do":"redo",title:"Redo (Ctrl+Shif\
t+Z)","aria-label":"Redo"}),show=()=>{document.activeElement!==name&&give(name,"value",store.name.replace(/[\r\n]+/g," ")),give(undo,"disabled",!store.history.canUndo),
give(redo,"disabled",!store.history.canRedo)};store.on("document history",show),show();let stop=button("Stop",()=>store.cancel(),{"data-do":"cancel",hidden:!0,"\
aria-label":"Stop solving"}),waiting;return store.on("state",()=>{clearTimeout(waiting),store.state==="solving"?waiting=setTimeout(()=>give(stop,"hidden",!1),PATIENCE):
give(stop,"hidden",!0)}),h("header",{class:"bs-head"},h("h1",{},"burmester studio"),files.element,name,h("div",{class:"bs-row"},undo,redo),banners.status,stop,banners.
live,settings.element,keys)}function stageBar(store,scene,drawn){let toggle=(text,name,make,data)=>{let made2=button(text,()=>scene.use(scene.tool?.name===name?
null:make()),{"data-do":data,"aria-pressed":"false"});return scene.on("tool",()=>put(made2,"aria-pressed",scene.tool?.name===name)),made2},snap=button("Snap",()=>{
scene.snap.isOn=!scene.snap.isOn,put(snap,"aria-pressed",scene.snap.isOn)},{"data-do":"snap","aria-pressed":"true",title:"Snap to the grid, pivots, corners and \
other poses; Alt frees, Shift holds an axis"}),zoom=(text,label,factor)=>button(text,()=>scene.zoom(factor,scene.size.width/2,scene.size.height/2),{"aria-label":label,
title:label}),bar=h("div",{class:"bs-bar",role:"toolbar","aria-label":"Tools of the plane"},toggle("Add poses","pose",()=>new PoseTool(store,scene),"add-poses"),
toggle("Add points","point",()=>new PointTool(store,scene),"add-points"),toggle("Draw a path","path",()=>new PathTool(store,scene,drawn),"draw-path"),h("span",{
class:"bs-gap"}),snap,button("Fit",()=>scene.fitAgain(),{"data-do":"fit",title:"Show the poses; once more: all of the body and the regions, too (0)"}),zoom("+",
"Zoom in",1.25),zoom("−","Zoom out",.8));return walkByArrows(bar,"button").first(),bar}function planeLine(store,scene){let line2=h("p",{class:"bs-line"}),show=()=>say(
line2,scene.tool?.hint??(store.document.poses.length?isPath(store.document)?CURVE:store.document.poses.some(isPoint2)?POINTS2:FIRST:EMPTY));return scene.on("too\
l",show),store.on("document",show),show(),line2}function refitWhenSolved(store,scene){let waits=!0;return scene.hold(()=>(waits?[]:currentLinkage(store)?.led??[]).
map(dyad=>dyad.fixed_pivot).filter(point2=>point2&&isNear(store,point2))),store.on("solved",()=>{let refit=waits&&scene.isFitted;waits=!1,refit&&scene.fit()}),()=>{
waits=!0,scene.fit()}}function isNear({solved,document:{poses}},[x,y]){return poses.some(pose=>Math.hypot(x-pose.x,y-pose.y)<3*(solved?.scene??1/0))}function listenToTokens(connection,banners){
addEventListener("hashchange",async()=>{location.hash&&(await connection.session(),connection.open())});let asked=!1;connection.on("open",()=>banners.close("exp\
ired")),connection.on("closed",async()=>{if(!asked){asked=!0;try{await connection.get("/start")}catch(error){error instanceof Refused&&error.status===401&&banners.
expired()}asked=!1}})}async function main(){let root=document.getElementById("studio"),connection=new Connection(decodeFrame);try{await connection.session();let start=await connection.
get("/start"),kept2=keptHere(),store=new Store({connection,document:start.document,options:start.options,name:start.name,...kept2}),parts=layOut(root,store,start);
start.saved&&!kept2&&offerSaved(store,parts,start.saved),listenToTokens(connection,parts.banners),document.documentElement.dataset.ready="true",connection.open()}catch(error){
addEventListener("hashchange",()=>location.reload());let[told]=error instanceof Refused&&error.status===401?error.messages:[];if(root.replaceChildren(h("p",{class:"\
bs-failed",role:"alert"},told?`The studio is not shown here: ${told.message}. What to do: ${told.help}.`:`The page could not start: ${error.message}. Is burmest\
er studio still running? Start it again and open the address that it prints.`)),!(error instanceof Refused))throw error}}function offerSaved(store,{files},saved){
let when=typeof saved.when=="number"?new Date(1e3*saved.when).toLocaleString():saved.when,line2=h("p",{class:"bs-quiet-line","data-saved":""},h("span",{},"Last \
time: ",h("bdi",{},saved.name),when?`, ${when}`:""),button("Go on with it",()=>{line2.remove(),store.replace(saved),files.opened()},{"data-do":"restore"}));document.
querySelector(".bs-left")?.prepend(line2)}main();
