namespace LagSim.Harness.Reports;

/// <summary>The style sheet of a report, light and dark, in the colours of its charts. Without characters that XML would escape.</summary>
internal static class ReportTheme
{
    internal const string Css = """

        :root{color-scheme:light dark;--bg:#ffffff;--ink:#1b1f24;--dim:#57606a;--rule:#d5dae0;--stripe:#f6f8fa}
        @media (prefers-color-scheme: dark){:root{--bg:#14171c;--ink:#e8eaed;--dim:#a3adb8;--rule:#363e48;--stripe:#1b2027}}
        *{box-sizing:border-box}
        body{margin:0;background:var(--bg);color:var(--ink);
        font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",Arial,sans-serif}
        main,footer{max-width:1000px;margin:0 auto;padding:0 20px}
        h1{font-size:26px;line-height:1.25;margin:32px 0 8px}
        h2{font-size:19px;margin:36px 0 8px}
        p{margin:8px 0 16px;max-width:75ch}
        .finding{font-size:17px;font-weight:600}
        .scroll{overflow-x:auto;margin:12px 0 24px}
        dl{columns:280px;column-gap:28px;margin:-8px 0 24px;font-size:13px}
        dl div{break-inside:avoid}
        dt{font-weight:600}
        dd{margin:0 0 6px;color:var(--dim)}
        table{border-collapse:collapse;font-size:14px;font-variant-numeric:tabular-nums}
        caption{text-align:left;color:var(--dim);padding:0 0 6px}
        th,td{text-align:left;vertical-align:top;padding:5px 12px;border-bottom:1px solid var(--rule)}
        th{font-weight:600;border-bottom-width:2px}
        tbody tr:nth-child(even){background:var(--stripe)}
        .n{text-align:right;white-space:nowrap}
        figure{margin:20px 0 28px;overflow-x:auto}
        figure svg{display:block;width:100%;min-width:860px;height:auto}
        figcaption{color:var(--dim);font-size:14px;margin-top:4px}
        footer{border-top:1px solid var(--rule);margin-top:40px;padding-top:12px;padding-bottom:32px;color:var(--dim);font-size:13px}
        code{font-family:ui-monospace,Consolas,"Liberation Mono",monospace}

        """;
}
