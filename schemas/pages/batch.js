// A click on a title sorts, by numbers where there are some. A button for each level leaves only its decks.
const body=document.querySelector("tbody"),filters=document.querySelector(".filters");
document.querySelectorAll("th").forEach((title,column)=>{
 const button=document.createElement("button");
 button.textContent=title.textContent;title.replaceChildren(button);
 let down=1;
 button.onclick=()=>{
  const text=row=>row.cells[column].textContent;
  body.append(...[...body.rows].sort((a,b)=>{
   const x=text(a),y=text(b),order=parseFloat(x)-parseFloat(y);
   return down*(isNaN(order)?x.localeCompare(y):order)}));
  down=-down}});
filters.hidden=false;
filters.onclick=e=>{
 const button=e.target.closest("button");if(!button)return;
 const on=button.getAttribute("aria-pressed")!=="true";
 for(const b of filters.children)b.setAttribute("aria-pressed",String(on&&b===button));
 for(const r of body.rows)r.hidden=on&&r.dataset.level!==button.dataset.level}
