using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>The names of the kinds of forces in scene files and tables, and the keys of each.</summary>
internal static class ForceKindNames
{
    private static readonly (ForceKind Kind, string Name, Keys Keys)[] All =
    [
        (ForceKind.LinearDrag, "linear_drag", new(["coefficient_kg_per_s"], ["medium_m_per_s"])),
        (ForceKind.QuadraticDrag, "quadratic_drag", new(["coefficient_kg_per_m"], ["medium_m_per_s"])),
        (ForceKind.Spring, "spring", new(["anchor_m", "stiffness_n_per_m"], ["damping_kg_per_s"])),
        (ForceKind.Magnetic, "magnetic", new(["field_t", "charge_c"], [])),
        (ForceKind.Magnus, "magnus", new(["coefficient_kg"], [])),
        (ForceKind.Central, "central", new(["centre_m", "strength_m_per_s2"], ["power"])),
    ];

    /// <summary>Returns the kinds that a file can have, as listed in an error.</summary>
    internal static string Quoted => "\"" + string.Join("\", \"", All.Select(each => each.Name)) + "\"";

    internal static string Of(ForceKind kind) => kind == ForceKind.Supplied ? "supplied" : All.First(each => each.Kind == kind).Name;

    internal static Keys KeysOf(ForceKind kind) => All.First(each => each.Kind == kind).Keys;

    internal static bool TryParse(string name, out ForceKind kind)
    {
        int at = Array.FindIndex(All, each => string.Equals(each.Name, name, StringComparison.Ordinal));
        kind = at < 0 ? ForceKind.Supplied : All[at].Kind;
        return at >= 0;
    }

    /// <summary>Returns the keys of a kind besides name and kind.</summary>
    internal readonly record struct Keys(IReadOnlyList<string> Required, IReadOnlyList<string> Optional);
}
