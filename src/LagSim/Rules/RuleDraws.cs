using LagSim.Events;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>The random numbers of a call of rules: functions of the scene's seed, the event, and how many were drawn.</summary>
internal sealed class RuleDraws(Scene scene, SimTime start)
{
    private EventKey key;
    private ImpactContact contact; // of an impact, which of its contacts the call is for
    private ulong draws;

    /// <summary>A call begins.</summary>
    internal void Begin(RuleCall call)
    {
        key = call.Key;
        contact = call.Trigger.Contact;
        draws = 0;
    }

    /// <summary>The next number.</summary>
    internal ulong Next()
    {
        StableHash hash = default;
        hash.Add(scene.Seed);
        hash.Add(key.Time - start);
        hash.Add(((ulong)key.Round << 8) | (byte)key.Kind);
        hash.Add(key.Body.Packed);
        hash.Add(key.Other.Packed);
        hash.Add(key.Origin);
        if (key.Kind == EventKind.Impact)
        {
            hash.Add(contact.First.Packed);
            hash.Add(contact.Second.Packed);
            hash.Add((long)contact.Surface);
        }

        hash.Add(draws++);
        return hash.Value;
    }
}
