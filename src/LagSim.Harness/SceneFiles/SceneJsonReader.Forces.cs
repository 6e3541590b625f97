using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <content>Forces, and which of them act on a body.</content>
internal ref partial struct SceneJsonReader
{
    private const int MaxListed = 10;

    private static readonly JsonKeys ForceKeys = new(
        ["name", "kind"],
        ["coefficient_kg_per_s", "coefficient_kg_per_m", "medium_m_per_s", "anchor_m", "stiffness_n_per_m", "damping_kg_per_s", "field_t", "charge_c", "coefficient_kg", "centre_m", "strength_m_per_s2", "power"]);

    private void ReadForce()
    {
        string name = "";
        string kind = "";
        Dictionary<string, double> numbers = new();
        Dictionary<string, Vector3D> vectors = new();
        uint seen = 0;
        cursor.EnterObject();
        while (cursor.NextKey(ForceKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "name":
                    name = Name();
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

        Force force = parsed switch
        {
            ForceKind.LinearDrag => Force.LinearDrag(name, numbers["coefficient_kg_per_s"], vectors.GetValueOrDefault("medium_m_per_s")),
            ForceKind.QuadraticDrag => Force.QuadraticDrag(name, numbers["coefficient_kg_per_m"], vectors.GetValueOrDefault("medium_m_per_s")),
            ForceKind.Spring => Force.Spring(name, vectors["anchor_m"], numbers["stiffness_n_per_m"], numbers.GetValueOrDefault("damping_kg_per_s")),
            ForceKind.Magnus => Force.Magnus(name, numbers["coefficient_kg"]),
            ForceKind.Magnetic => Force.Magnetic(name, vectors["field_t"], numbers["charge_c"]),
            _ => Force.Central(name, vectors["centre_m"], numbers["strength_m_per_s2"], Power(numbers.GetValueOrDefault("power", -2))),
        };
        forceNames.Add(name);
        Add(b => b.AddForce(force));
    }

    private readonly int Power(double power) => power == Math.Floor(power) && Math.Abs(power) < 1000
        ? (int)power
        : throw cursor.FailAt("power", $"the power is {power:R}; it must be a whole number between -4 and 4");

    private List<string> ForcesOnBody()
    {
        List<string> names = new();
        cursor.EnterArray("an array of the names of forces");
        while (cursor.NextElement())
        {
            string name = cursor.String();
            if (names.Contains(name))
            {
                throw cursor.Fail($"the force {JsonFault.Quote(name)} stands here twice; each may stand once");
            }

            names.Add(name);
            namedForces.Add((name, cursor.Fail("named here")));
        }

        return names;
    }

    /// <summary>Returns the set of named forces, once all are known.</summary>
    private static ForceSet SetOf(List<string> names, List<string> known)
    {
        ForceSet set = ForceSet.None;
        foreach (string name in names)
        {
            int at = known.IndexOf(name);
            set |= at is >= 0 and < ForceSet.MaxForces ? ForceSet.Of(at) : ForceSet.None; // the builder refuses too many forces
        }

        return set;
    }

    private readonly void CheckForceNames()
    {
        foreach ((string name, SceneFileException where) in namedForces)
        {
            if (!forceNames.Contains(name))
            {
                string there = forceNames.Count == 0 ? "it has none"
                    : $"it has {string.Join(", ", forceNames.Take(MaxListed).Select(JsonFault.Quote))}{(forceNames.Count > MaxListed ? $" and {forceNames.Count - MaxListed} more" : "")}";
                throw new SceneFileException(where.File, where.Path, where.Line, $"no force of the scene is named {JsonFault.Quote(name)}; {there}");
            }
        }
    }
}
