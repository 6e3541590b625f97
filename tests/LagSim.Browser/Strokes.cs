using System.Linq;
using System.Text.Json;
using System.Threading.Tasks;

namespace LagSim.Browser;

/// <summary>A line that the page drew on a canvas.</summary>
/// <param name="Colour">Its colour, as a canvas tells it.</param>
/// <param name="Alpha">How opaque it is, 0 to 1.</param>
/// <param name="IsDashed">Whether it has dashes.</param>
internal sealed record Stroke(string Colour, double Alpha, bool IsDashed);

/// <summary>Listens to what the page draws.</summary>
internal static class Strokes
{
    /// <summary>From now on every line is noted.</summary>
    internal static Task SpyAsync(OpenedPage page) => page.Page.EvaluateAsync(
        """
        () => {
          window.strokes = []
          const stroke = CanvasRenderingContext2D.prototype.stroke
          CanvasRenderingContext2D.prototype.stroke = function () {
            window.strokes.push({ colour: this.strokeStyle, alpha: this.globalAlpha, dashed: this.getLineDash().length > 0 })
            return stroke.call(this)
          }
        }
        """);

    /// <summary>The lines since the last time.</summary>
    internal static async Task<Stroke[]> TakeAsync(OpenedPage page)
    {
        JsonElement strokes = await page.Page.EvaluateAsync<JsonElement>("() => window.strokes.splice(0)");
        return [.. strokes.EnumerateArray().Select(s => new Stroke(
            s.GetProperty("colour").GetString()!, s.GetProperty("alpha").GetDouble(), s.GetProperty("dashed").GetBoolean()))];
    }

    /// <summary>A colour of the page, by its name in the style sheet.</summary>
    internal static Task<string> ColourAsync(OpenedPage page, string name) =>
        page.Page.EvaluateAsync<string>("name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim()", name);
}
