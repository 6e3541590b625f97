using System;
using System.Collections.Generic;
using System.Linq;

namespace LagSim.Tests.Architecture;

/// <summary>Holds arrows against a table of layers.</summary>
internal sealed class LayerRules
{
    private readonly Dictionary<string, int> heights;
    private readonly Dictionary<string, string> placed;

    internal LayerRules(IEnumerable<string[]> order, IEnumerable<PlacedType> placed)
    {
        heights = order.SelectMany((folders, height) => folders.Select(folder => (folder, height))).ToDictionary(one => one.folder, one => one.height);
        this.placed = placed.ToDictionary(one => one.Type, one => one.Layer);
    }

    /// <summary>Each arrow that does not point down, as a sentence. A folder that is not in the table is one too.</summary>
    internal string[] Broken(IEnumerable<Arrow> arrows) => arrows
        .Select(arrow => (Arrow: arrow, From: Layer(arrow.FromFolder, arrow.From), To: Layer(arrow.ToFolder, arrow.To)))
        .Where(use => use.From != use.To && !(heights.TryGetValue(use.From, out int from) && heights.TryGetValue(use.To, out int to) && to < from))
        .Select(use => $"{use.Arrow.From} uses {use.Arrow.To}, but {use.From} must not know {use.To}")
        .Order(StringComparer.Ordinal)
        .ToArray();

    private string Layer(string folder, string type) => placed.GetValueOrDefault(type, folder);
}
