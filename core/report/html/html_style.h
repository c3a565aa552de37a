// How the page of the report looks: light, dark, narrow and on paper.
#ifndef DHCAL_CORE_REPORT_HTML_HTML_STYLE_H_
#define DHCAL_CORE_REPORT_HTML_HTML_STYLE_H_

namespace dhcal {

/// The style sheet. The inks are those of core/report/html/plot_script.h; text and series stand
/// apart from the paper by a contrast of 4.5 and 3 or more.
constexpr char kHtmlStyle[] = R"css(
:root{color-scheme:light dark;--paper:#fff;--card:#f5f7fa;--rule:#d5dbe3;--faint:#5b6675;
--link:#0b57a4;--ink-10:#1b2430;--ink-11:#e3e8ee;--ink-12:#8a95a3;--ink-13:#5b6675;
--ink-20:#0b6fb8;--ink-21:#b3541e;--ink-22:#2b7d3a;--ink-23:#8a3fa0;--ink-24:#8a6d00;--ink-25:#a3304d;
--ink-30:#c8501c;--ink-31:#0b6fb8;--ink-32:#8a95a3;
--ink-40:#d6e6f4;--ink-41:#8fbfe0;--ink-42:#3f8fc9;--ink-43:#08497d}
@media screen and (prefers-color-scheme:dark){:root{--paper:#12171e;--card:#1b222c;--rule:#36404d;
--faint:#a3afbd;--link:#79b8f2;--ink-10:#e4e9ef;--ink-11:#29323d;--ink-12:#6d7987;--ink-13:#a3afbd;
--ink-20:#5aaef0;--ink-21:#f0955c;--ink-22:#6cc47c;--ink-23:#cf8fe0;--ink-24:#d6b64a;--ink-25:#f07f98;
--ink-30:#f0955c;--ink-31:#5aaef0;--ink-32:#7d8896;
--ink-40:#20354a;--ink-41:#2c5c85;--ink-42:#4490c9;--ink-43:#a8d6fa}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink-10);
font:16px/1.5 system-ui,"Segoe UI",Roboto,"Liberation Sans",Arial,sans-serif;overflow-wrap:anywhere}
header,main,nav,footer{max-width:66rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:1.75rem}
h1{font-size:1.7rem;line-height:1.2;margin:0}
h2{font-size:1.2rem;line-height:1.3;margin:0 0 .6rem}
section{margin:2.2rem 0}
p,ul,ol,dl{margin:.6rem 0;max-width:50rem}
li{margin:.3rem 0}
a{color:var(--link)}
.program,figcaption,.more,footer,caption small,th small{color:var(--faint)}
.program{margin:.2rem 0 0}
.answer section{background:var(--card);border:1px solid var(--rule);border-radius:.5rem;
padding:1rem 1.25rem;margin:1rem 0}
.answer section:first-child{border-left:.35rem solid var(--ink-31)}
.answer section:first-child>p:first-of-type{font-size:1.15rem}
nav ul{display:flex;flex-wrap:wrap;gap:.2rem 1.1rem;list-style:none;padding:0;max-width:none}
main nav{padding:0}nav li{margin:0}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.3rem 1rem}
dt{font-weight:600}
dd{margin:0}
.parts{list-style:none;padding-left:1.1rem;margin:.2rem 0;color:var(--ink-10)}
.table{overflow-x:auto;margin:1rem 0}
table{border-collapse:collapse;font-size:.9rem;font-variant-numeric:tabular-nums;
overflow-wrap:normal}
caption{text-align:left;font-weight:600;padding-bottom:.3rem}
th,td{padding:.22rem .7rem;text-align:right;vertical-align:top;white-space:nowrap}
th{font-weight:600;vertical-align:bottom;border-bottom:2px solid var(--rule);white-space:normal}
td{border-bottom:1px solid var(--rule)}
th.words,td.words{text-align:left;white-space:normal;min-width:6rem}
th:first-child,td:first-child{padding-left:0}
figure{margin:1.6rem 0}
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,19rem),1fr));gap:.8rem}
.plots.one{max-width:32rem;grid-template-columns:1fr}
.plots.two{max-width:58rem;grid-template-columns:repeat(auto-fill,minmax(min(100%,23rem),1fr))}
.plots svg{display:block;width:100%;height:auto}
svg text,svg g{font-family:inherit}
figcaption{font-size:.92rem;max-width:50rem;margin-top:.4rem}
.notice{border:1px solid var(--rule);border-left:.35rem solid var(--ink-30);padding:.5rem 1rem;
max-width:50rem}
footer{padding:1rem 1.25rem 2rem;font-size:.9rem}
@media (max-width:34rem){header,main,nav,footer{padding-left:.8rem;padding-right:.8rem}
.answer section{padding:.8rem .9rem}dl{grid-template-columns:1fr;gap:0}dd{margin-bottom:.5rem}
th,td{padding:.2rem .4rem}}
@page{size:A4;margin:16mm 14mm}
@media print{body{font-size:10pt}h1{font-size:16pt}h2{font-size:12pt}figcaption{font-size:9pt}
.answer section:first-child>p:first-of-type{font-size:11pt}header,main,nav,footer{max-width:none;padding:0}
.answer{break-after:page}.answer section,figure,tr{break-inside:avoid}h2{break-after:avoid}
section{margin:1.2rem 0}nav,.data{display:none}.table{overflow:visible}table{font-size:8pt}
th,td{padding:.1rem .35rem}
.plots{grid-template-columns:repeat(3,1fr)}.plots.one{max-width:10cm;grid-template-columns:1fr}
.plots.two{grid-template-columns:1fr 1fr;max-width:none}a{color:inherit;text-decoration:none}}
)css";

}  // namespace dhcal

#endif  // DHCAL_CORE_REPORT_HTML_HTML_STYLE_H_
