#include "meniscus/report/page_style.hpp"

namespace meniscus::report {

std::string_view page_style() {
  return R"(
:root{color-scheme:light dark;--paper:#f6f7f9;--card:#ffffff;--ink:#1b2027;--soft:#5c6671;
--line:#dfe3e8;--accent:#0072b2;--bar:#8fbcd9;--good:#1a7f5a;--bad:#b3401a}
@media screen and (prefers-color-scheme:dark){:root{--paper:#0f1216;--card:#15191e;--ink:#e8ebee;
--soft:#98a2ad;--line:#2a3038;--accent:#56a8e0;--bar:#2f6288;--good:#35c79b;--bad:#f08a4b}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.55 "Source Sans 3",
"Source Sans Pro",system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,"DejaVu Sans",sans-serif}
main{max-width:1180px;margin:0 auto;padding:40px 24px 64px}
header{margin-bottom:28px}
h1{font-size:30px;line-height:1.2;font-weight:650;letter-spacing:-.01em;margin:0 0 6px}
h2{font-size:19px;font-weight:650;margin:44px 0 14px}
.lead{color:var(--soft);font-size:17px;margin:0}
.lead i{font-family:Georgia,"Times New Roman",serif}
.status{display:inline-block;font-size:13px;font-weight:600;padding:1px 10px;border-radius:99px;
border:1px solid currentColor;margin-left:10px;vertical-align:5px;letter-spacing:0}
.done{color:var(--good)}.failed{color:var(--bad)}.other{color:var(--soft)}
.notice{border-left:3px solid var(--bad);background:var(--card);padding:8px 16px;margin:16px 0 0}
.notice p{margin:2px 0}
.tiles{display:flex;flex-wrap:wrap;gap:1px;
background:var(--line);border:1px solid var(--line);border-radius:8px;overflow:hidden;margin:0}
.tiles div{background:var(--card);padding:12px 16px;flex:1 1 auto}
.tiles dt{font-size:13px;color:var(--soft)}
.tiles dd{margin:0;font-size:21px;font-weight:600;font-variant-numeric:tabular-nums;white-space:nowrap}
.tiles dd small{font-size:14px;font-weight:400;color:var(--soft)}
.card{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:16px}
.frames{display:grid;grid-template-columns:repeat(auto-fill,minmax(240px,1fr));gap:8px 16px}
figure{margin:0;break-inside:avoid}
figcaption{font-size:14px;color:var(--soft);text-align:center;font-variant-numeric:tabular-nums}
.card>figcaption{text-align:left;padding-top:8px}
:not(svg)>svg{display:block;width:100%;height:auto}
.key{max-width:560px;margin:8px 0 0}
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,460px),1fr));gap:16px}
.sections{margin-top:16px}
.sections .key{grid-column:1/-1;margin:0}
.card+.card,.columns+.card{margin-top:16px}.columns .card,.plots .card{margin-top:0}
.columns{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,420px),1fr));gap:16px;
align-items:start}
table{border-collapse:collapse;width:100%;font-size:15px;font-variant-numeric:tabular-nums}
caption{text-align:left;font-weight:600;padding:0 0 6px}
th,td{text-align:left;padding:5px 12px 5px 0;border-top:1px solid var(--line);vertical-align:top}
th{font-weight:400;color:var(--soft);white-space:nowrap}
td{overflow-wrap:anywhere}
td.n,th.n{text-align:right;white-space:nowrap;padding:5px 0 5px 12px}
thead th{border-top:0;font-size:13px}
.scroll{overflow-x:auto}
.phase{width:45%}
.phase span{display:block;height:12px;margin-top:6px;min-width:1px;border-radius:2px;background:var(--bar)}
details{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:10px 16px;margin-top:12px}
summary{cursor:pointer;font-weight:600}
pre{font:13.5px/1.5 ui-monospace,"SF Mono",Menlo,Consolas,"DejaVu Sans Mono",monospace;overflow-x:auto;
margin:10px 0 4px;tab-size:4}
footer{margin-top:48px;color:var(--soft);font-size:14px}
@media (max-width:600px){main{padding:24px 14px 40px}h1{font-size:25px}.card{padding:10px}
.frames{grid-template-columns:repeat(auto-fill,minmax(150px,1fr))}}
@media print{body{background:#fff;font-size:10.5pt}main{max-width:none;padding:0}
.card,details{border:0;padding:0}h2{margin-top:22px;break-after:avoid}
.plots{grid-template-columns:1fr 1fr;gap:10px}.columns{grid-template-columns:1fr 1fr}
.frames{grid-template-columns:repeat(4,1fr)}
.phase span,svg *{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";
}

}  // namespace meniscus::report
