using System.Globalization;
using System.Text;

namespace LagSim.Harness.Reports.Charts;

/// <summary>
/// The colours and fonts of charts, light and dark. The palette is that of Okabe and Ito, which colour-blind readers can distinguish, with
/// lightness adjusted for contrast with the background. After its seven colours come five more for charts with markers.
/// </summary>
internal static class ChartTheme
{
    private static readonly string[] Light =
    [
        "#0072b2", "#d55e00", "#008a64", "#b5508d", "#a87400", "#3b9ad1", "#3d3d3d",
        "#2a35c9", "#8040c8", "#b0123c", "#7a4a1e", "#5c6b00",
    ];
    private static readonly string[] Dark =
    [
        "#56b4e9", "#f5894a", "#2fc99b", "#e59bc8", "#f0e442", "#a3b8ff", "#d8d8d8",
        "#7d8bff", "#c08cff", "#ff6b81", "#c9a27c", "#b7cf4a",
    ];

    // Colour names: background, text, quieter text, grid, frame, annotation.
    private static readonly string[] Names = ["bg", "ink", "dim", "grid", "axis", "note"];
    private static readonly string[] LightInks = ["#ffffff", "#1b1f24", "#57606a", "#e4e7eb", "#8c959f", "#6e4fa3"];
    private static readonly string[] DarkInks = ["#14171c", "#e8eaed", "#a3adb8", "#2b313a", "#6b7683", "#c3a9f0"];

    /// <summary>The number of colours that can be distinguished by colour alone.</summary>
    internal static int Colours => 7;

    /// <summary>Returns the CSS class of a curve's colour.</summary>
    internal static string ColourClass(int slot) => "c" + (slot % Light.Length).ToString(CultureInfo.InvariantCulture);

    /// <summary>
    /// The style sheet. All rules are confined to <c>.lagsim-chart</c>, since an inline SVG shares its page's styles. It has no character
    /// that XML or HTML would escape.
    /// </summary>
    internal static string Css { get; } = Build();

    private static string Build()
    {
        StringBuilder css = new();
        css.Append("\n.lagsim-chart{").Append(Variables(LightInks, Light))
            .Append("font:12px system-ui,-apple-system,\"Segoe UI\",Roboto,\"Liberation Sans\",Arial,sans-serif;color-scheme:light dark}\n")
            .Append("@media (prefers-color-scheme: dark){.lagsim-chart{").Append(Variables(DarkInks, Dark)).Append("}}\n");

        // Each colour appears twice: viewers without CSS variables use the first, the light one.
        Rule(css, "text", "fill", "ink", "");
        Rule(css, ".bg", "fill", "bg", "");
        Rule(css, ".grid", "stroke", "grid", "fill:none;stroke-width:1");
        Rule(css, ".minor", "stroke", "grid", "fill:none;stroke-width:1;opacity:.5");
        Rule(css, ".band", "fill", "grid", "stroke:none;opacity:.6");
        Rule(css, ".frame", "stroke", "axis", "fill:none;stroke-width:1");
        Rule(css, ".tick", "fill", "dim", "font-variant-numeric:tabular-nums");
        Rule(css, ".label", "fill", "dim", "");
        Rule(css, ".ref", "stroke", "note", "fill:none;stroke-width:1.25;stroke-dasharray:2 3");
        Rule(css, ".mark", "stroke", "note", "fill:none;stroke-width:1.25;opacity:.85");
        Rule(css, ".impact", "fill", "note", "stroke:none");
        Rule(css, ".note", "fill", "note", "");
        css.Append(".lagsim-chart .h1{font-size:16px;font-weight:600}\n.lagsim-chart .h2{font-size:13px;font-weight:600}\n")
            .Append(".lagsim-chart .mid{text-anchor:middle}\n.lagsim-chart .end{text-anchor:end}\n")
            .Append(".lagsim-chart .line{fill:none;stroke-width:1.75;stroke-linejoin:round;stroke-linecap:round}\n")
            .Append(".lagsim-chart .point{fill:none;stroke-width:1.75;stroke-linejoin:round;stroke-linecap:round}\n")
            .Append(".lagsim-chart .dashed{stroke-dasharray:5 6}\n.lagsim-chart .gaps{stroke-dashoffset:5.5}\n")
            .Append(".lagsim-chart .dots{stroke-width:5}\n.lagsim-chart .strong{stroke-width:2.75}\n");
        for (int i = 0; i < Light.Length; i++)
        {
            string slot = ColourClass(i);
            css.Append(CultureInfo.InvariantCulture, $".lagsim-chart .{slot}{{stroke:{Light[i]};stroke:var(--lagsim-{slot})}}\n")
                .Append(CultureInfo.InvariantCulture, $".lagsim-chart .impact.{slot}{{stroke:none;fill:{Light[i]};fill:var(--lagsim-{slot})}}\n")
                .Append(CultureInfo.InvariantCulture, $".lagsim-chart .solid.{slot}{{fill:{Light[i]};fill:var(--lagsim-{slot})}}\n");
        }

        return css.ToString();
    }

    private static void Rule(StringBuilder css, string selector, string property, string name, string rest)
    {
        string fallback = LightInks[System.Array.IndexOf(Names, name)];
        css.Append(CultureInfo.InvariantCulture, $".lagsim-chart {selector}{{{property}:{fallback};{property}:var(--lagsim-{name});{rest}}}\n");
    }

    private static string Variables(string[] inks, string[] palette)
    {
        StringBuilder css = new();
        for (int i = 0; i < inks.Length; i++)
        {
            css.Append(CultureInfo.InvariantCulture, $"--lagsim-{Names[i]}:{inks[i]};");
        }

        for (int i = 0; i < palette.Length; i++)
        {
            css.Append(CultureInfo.InvariantCulture, $"--lagsim-c{i}:{palette[i]};");
        }

        return css.ToString();
    }
}
