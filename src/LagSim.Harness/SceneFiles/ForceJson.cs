using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>Reads the forces of scene files.</summary>
internal static class ForceJson
{
    private static readonly JsonKeys Keys = new(
        ["name", "kind"],
        ["coefficient_kg_per_s", "coefficient_kg_per_m", "medium_m_per_s", "anchor_m", "stiffness_n_per_m", "damping_kg_per_s", "field_t", "charge_c", "coefficient_kg", "centre_m", "strength_m_per_s2", "power"]);

    /// <summary>Reads a force.</summary>
    /// <exception cref="SceneFileException">A key is missing, or does not belong to a force of that kind.</exception>
    internal static Force Read(ref JsonCursor cursor)
    {
        string name = "";
        string kind = "";
        Dictionary<string, double> numbers = new();
        Dictionary<string, Vector3D> vectors = new();
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(Keys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = SceneJsonValues.Name(ref cursor);
                    break;
                case "kind":
                    kind = cursor.String();
                    break;
                case "medium_m_per_s" or "anchor_m" or "field_t" or "centre_m":
                    vectors.Add(key, cursor.Vector());
                    break;
                default:
                    numbers.Add(key, cursor.Number());
                    break;
            }
        }

        if (!ForceKindNames.TryParse(kind, out ForceKind parsed))
        {
            throw cursor.FailAt("kind", $"the kind of force {JsonFault.Quote(kind)} is unknown; allowed are {ForceKindNames.Quoted}");
        }

        ForceKindNames.Keys of = ForceKindNames.KeysOf(parsed);
        foreach (string given in numbers.Keys.Concat(vectors.Keys))
        {
            if (!of.Required.Contains(given) && !of.Optional.Contains(given))
            {
                throw cursor.FailAt(given, $"a force of kind \"{kind}\" has no such key; it has {string.Join(", ", of.Required.Concat(of.Optional))}");
            }
        }

        foreach (string needed in of.Required)
        {
            if (!numbers.ContainsKey(needed) && !vectors.ContainsKey(needed))
            {
                throw cursor.FailAt(needed, $"this key is required of a force of kind \"{kind}\"");
            }
        }

        return parsed switch
        {
            ForceKind.LinearDrag => Force.LinearDrag(name, numbers["coefficient_kg_per_s"], vectors.GetValueOrDefault("medium_m_per_s")),
            ForceKind.QuadraticDrag => Force.QuadraticDrag(name, numbers["coefficient_kg_per_m"], vectors.GetValueOrDefault("medium_m_per_s")),
            ForceKind.Spring => Force.Spring(name, vectors["anchor_m"], numbers["stiffness_n_per_m"], numbers.GetValueOrDefault("damping_kg_per_s")),
            ForceKind.Magnus => Force.Magnus(name, numbers["coefficient_kg"]),
            ForceKind.Magnetic => Force.Magnetic(name, vectors["field_t"], numbers["charge_c"]),
            _ => Force.Central(
                name, vectors["centre_m"], numbers["strength_m_per_s2"], Power(cursor, numbers.GetValueOrDefault("power", -2))),
        };
    }

    private static int Power(in JsonCursor cursor, double power) => power == Math.Floor(power) && Math.Abs(power) < 1000
        ? (int)power
        : throw cursor.FailAt("power", $"the power is {power:R}; it must be a whole number between -4 and 4");
}
