using System;
using System.Collections.Generic;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>
/// The parser of scene files: the keys, their meaning to a <see cref="SceneBuilder"/>, and which may be left out.
/// </summary>
internal ref struct SceneJsonReader
{
    private static readonly JsonKeys SceneKeys =
        new(["format", "name"], ["gravity_m_per_s2", "resolution_m", "contact_tolerance_m", "smallest_radius_m", "spawners", "periodic_box_m", "forces", "planes", "static_spheres", "bodies", "sensors", "rules", "seed"]);

    private readonly string? locate;
    private readonly List<Action<SceneBuilder>> parts = new(); // parts to build once the name is known
    private readonly ForceNames forceNames = new();
    private JsonCursor cursor;

    /// <param name="json">The document, known to be UTF-8.</param>
    /// <param name="file">The name for error messages.</param>
    /// <param name="locate">The scene's name, or null. With a name, every part is also built by itself, so that an error is reported at its
    /// position: the limits are in the builder, which names a part but does not know its position in the file. A document that does not
    /// build is read again like this.</param>
    internal SceneJsonReader(ReadOnlySpan<byte> json, string file, string? locate)
    {
        cursor = new JsonCursor(json, file);
        this.locate = locate;
    }

    /// <summary>The scene's name in the document, as far as it was read.</summary>
    internal string SceneName { get; private set; } = "";

    /// <summary>Reads the scene.</summary>
    /// <exception cref="SceneFileException">The document holds no scene; the message names the position.</exception>
    /// <exception cref="SceneException">Every part can be read, but together they make no scene.</exception>
    internal Scene Read()
    {
        cursor.Read();
        cursor.EnterObject();
        uint seen = 0;
        while (cursor.NextKey(SceneKeys, ref seen) is string key)
        {
            switch (key)
            {
                case "format":
                    CheckFormat();
                    break;
                case "name":
                    SceneName = SceneJsonValues.Name(ref cursor);
                    break;
                case "gravity_m_per_s2":
                    Vector3D gravity = cursor.Vector();
                    Add(b => b.WithGravity(gravity));
                    break;
                case "resolution_m":
                    double restitutionThreshold = cursor.Number();
                    Add(b => b.WithRestitutionThreshold(restitutionThreshold));
                    break;
                case "contact_tolerance_m":
                    double tolerance = cursor.Number();
                    Add(b => b.WithContactTolerance(tolerance));
                    break;
                case "seed":
                    ulong seed = cursor.Whole(ulong.MaxValue);
                    Add(b => b.WithSeed(seed));
                    break;
                case "rules":
                    string named = cursor.String();
                    SceneRules rules = BuiltInRules.Named(named)
                        ?? throw cursor.Fail($"there are no built-in rules {JsonFault.Quote(named)}; there are {BuiltInRules.KnownNames}");
                    Add(b => b.WithRules(rules));
                    break;
                case "smallest_radius_m":
                    double smallest = cursor.Number();
                    Add(b => b.WithSmallestRadius(smallest));
                    break;
                case "spawners":
                    PeerSet spawners = SceneJsonValues.Peers(ref cursor);
                    Add(b => b.WithSpawners(spawners));
                    break;
                case "periodic_box_m":
                    Vector3D box = cursor.Vector();
                    if (box == Vector3D.Zero)
                    {
                        throw cursor.Fail("the sides of the periodic box are [0, 0, 0]; each must be above zero, at least five times the largest diameter,"
                            + " or the key left out");
                    }

                    Add(b => b.WithPeriodicBox(box));
                    break;
                default:
                    ReadList(key);
                    break;
            }
        }

        cursor.Read(); // nothing may follow
        forceNames.Check();
        SceneBuilder builder = new(SceneName);
        parts.ForEach(add => add(builder));
        return builder.Build();
    }

    private void ReadList(string key)
    {
        cursor.EnterArray("an array of objects");
        while (cursor.NextElement())
        {
            switch (key)
            {
                case "planes":
                    Add(PartJson.Plane(ref cursor));
                    break;
                case "static_spheres":
                    Add(PartJson.Sphere(ref cursor));
                    break;
                case "sensors":
                    Add(SensorJson.Read(ref cursor));
                    break;
                case "forces":
                    Force force = ForceJson.Read(ref cursor);
                    forceNames.Add(force.Name);
                    Add(b => b.AddForce(force));
                    break;
                default:
                    Add(PartJson.Body(ref cursor, forceNames, isAlone: locate is not null));
                    break;
            }
        }
    }

    private void Add(Action<SceneBuilder> part)
    {
        parts.Add(part);
        if (locate is null)
        {
            return;
        }

        SceneBuilder alone = new SceneBuilder(locate).WithGravity(Vector3D.Zero); // accepts every part that is valid by itself
        try
        {
            part(alone);
            alone.Build();
        }
        catch (SceneException cause)
        {
            throw cursor.Fail(cause.Message, cause);
        }
    }

    private void CheckFormat()
    {
        string format = cursor.String();
        if (format != SceneFile.Format)
        {
            throw cursor.Fail($"the format is {JsonFault.Quote(format)}; this version reads \"{SceneFile.Format}\" only");
        }
    }
}
