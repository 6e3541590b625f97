using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Scenes;

namespace LagSim.Rules;

/// <summary>Reads the world for a call of rules, and notes what it read.</summary>
internal sealed class RuleReads(Scene scene, RuleView view)
{
    private readonly List<RuleRead> reads = new();
    private EventKey key;

    /// <summary>What the call read.</summary>
    internal List<RuleRead> All => reads;

    /// <summary>A call begins.</summary>
    internal void Begin(in EventKey of)
    {
        key = of;
        reads.Clear();
    }

    /// <summary>A body's state, hold and properties.</summary>
    internal RuleRead Body(BodyId body) => Note(view.ReadBody(body, key));

    /// <summary>Whether a body is inside of a sensor.</summary>
    internal bool IsInside(BodyId body, int sensor)
    {
        if (sensor < 0 || sensor >= scene.SensorArray.Length)
        {
            string there = Limits.Count(scene.SensorArray.Length, "sensor", "sensors");
            throw new RuleException($"Sensor {sensor} is asked for; the scene has {there}, numbered from 0.");
        }

        return Note(view.ReadSensor(body, sensor, key)).IsInside;
    }

    /// <summary>The bodies whose centres lie within a sphere; how many there are.</summary>
    internal int Within(in Vector3D centre, double radius, Span<BodyId> found)
    {
        if (!centre.IsFinite || !(radius >= 0) || double.IsInfinity(radius))
        {
            throw new RuleException($"A sphere of radius {radius} m at {centre} m is asked for; both must be finite, and the radius at least zero.");
        }

        int region = reads.Count;
        view.ReadRegion(centre, radius, key, reads);
        Check();
        int count = reads[region].Count;
        for (int n = 0; n < count && n < found.Length; n++)
        {
            found[n] = reads[region + 1 + n].Body;
        }

        return count;
    }

    /// <summary>Whether there is room for a body, which may be left out of what is in the way.</summary>
    internal bool HasRoom(in BodySpec spec, in Vector3D centre, BodyId? leftOut)
    {
        if (!centre.IsFinite)
        {
            throw new RuleException($"Room at {centre} m is asked for; the place must be finite.");
        }

        return Note(view.ReadRoom(spec, centre, leftOut, key)).HasRoom;
    }

    private RuleRead Note(in RuleRead read)
    {
        reads.Add(read);
        Check();
        return read;
    }

    private void Check()
    {
        if (reads.Count > RuleWorld.MaxReads)
        {
            throw new RuleException($"A call read {RuleWorld.MaxReads} things of the world; it may read no more.");
        }
    }
}
