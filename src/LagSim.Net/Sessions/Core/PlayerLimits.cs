using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Net.Sessions.Core;

/// <summary>
/// The limits on one player's actions: how fast bodies may be set, and how many may be spawned. The host enforces them on events; a client
/// checks its own actions.
/// </summary>
/// <remarks>These are not rules of the world: an accepted event happens on every peer, whatever their own limits.</remarks>
internal sealed class PlayerLimits
{
    private readonly SessionOptions options;
    private readonly Dictionary<BodyId, Birth> spawned = new(); // existing and recently removed bodies

    internal PlayerLimits(SessionOptions options) => this.options = options;

    /// <summary>Returns the verdict on an event, and for one that exceeds a limit the reason.</summary>
    internal Verdict WhyNot(in ExternalEvent external, Simulation world, SimTime now, out string sentence)
    {
        sentence = "";
        if (external.Kind == EventKind.Spawn && external.Velocity.Length <= options.MaxGivenSpeed && SurfaceSpeed(external) <= options.MaxGivenSpeed)
        {
            ForgetBefore(now - options.MostLateness);
            if (spawned.Count < options.MaxSpawned || CountOf(external.Peer, now) < options.MaxSpawned)
            {
                return Verdict.Accepted;
            }

            sentence = $"Peer {external.Peer} has spawned {options.MaxSpawned} {(options.MaxSpawned == 1 ? "body that is" : "bodies that are")} still there, and no"
                + " player may have more at a time; some have to be removed first.";
            return Verdict.NoRight;
        }

        if (external.Kind == EventKind.Grab)
        {
            return WhyNoHand(external, world, out sentence);
        }

        bool turns = external.Kind == EventKind.Spawn && SurfaceSpeed(external) > external.Velocity.Length;
        double before = 0;
        double speed = turns ? SurfaceSpeed(external) : SpeedAfter(external, world, out before);
        if (speed <= options.MaxGivenSpeed || speed <= before)
        {
            return Verdict.Accepted;
        }

        sentence = FormattableString.Invariant(
            $"The {external.Kind} gives {(turns ? "the surface of " : "")}{world.Scene.Describe(external.Body)} a speed of {speed:R} m/s;")
            + FormattableString.Invariant($" in this session a player may give {options.MaxGivenSpeed:R} m/s at most.");
        return Verdict.Invalid;
    }

    /// <summary>
    /// A hand is no stronger than a player's may be; on a body that it spawns later, of any mass, it has to say how strong it is.
    /// </summary>
    private Verdict WhyNoHand(in ExternalEvent grab, Simulation world, out string sentence)
    {
        bool isLater = grab.Body.Peer == grab.Peer && grab.Body.Sequence > grab.Sequence;
        double usual = HandStrength.DefaultForce(MassOf(grab.Body, world));
        double force = grab.MaxForce > 0 ? grab.MaxForce : isLater && options.MaxHandForce > 0 ? double.PositiveInfinity : usual;
        double mostForce = options.MaxHandForce > 0 ? options.MaxHandForce : isLater && grab.MaxForce > 0 ? 0 : usual;
        double power = grab.MaxPower > 0 ? grab.MaxPower : HandStrength.DefaultPower(force);
        double mostPower = options.MaxHandPower > 0 ? options.MaxHandPower : HandStrength.DefaultPower(mostForce);
        sentence = force > mostForce ? TooStrong(grab, world, "force", force, mostForce, "N")
            : power > mostPower ? TooStrong(grab, world, "power", power, mostPower, "W") : "";
        return sentence.Length > 0 ? Verdict.Invalid : Verdict.Accepted;
    }

    private static string TooStrong(
        in ExternalEvent grab, Simulation world, string what, double asked, double most, string unit) =>
        FormattableString.Invariant($"The Grab takes {world.Scene.Describe(grab.Body)} with a greatest {what} of {asked:R} {unit};")
        + FormattableString.Invariant($" in this session a player's hand has {most:R} {unit} there at most.");

    /// <summary>
    /// Counts a player's spawned bodies that exist. A separate method, because a lambda's closure is allocated where its method begins.
    /// </summary>
    private int CountOf(byte player, SimTime now) => spawned.Count(s => s.Key.Peer == player && s.Value.Removed > now);

    /// <summary>
    /// Returns a player's spawned bodies that are not removed, including those whose spawn is still to come, each with its spawn time, by
    /// identity; or those among the named bodies, of any player.
    /// </summary>
    internal List<(BodyId Body, SimTime Since)> Spawned(byte player, ICollection<BodyId>? named = null) => spawned
        .Where(s => s.Value.Removed == SimTime.MaxValue && (named?.Contains(s.Key) ?? s.Key.Peer == player))
        .OrderBy(s => s.Key)
        .Select(s => (s.Key, s.Value.Since))
        .ToList();

    /// <summary>Records an event that was accepted, or done here and not refused yet.</summary>
    internal void Note(in ExternalEvent external)
    {
        if (external.Kind == EventKind.Spawn)
        {
            spawned[external.Body] = new Birth(external.Spec.Mass, external.Time);
        }
        else if (external.Kind == EventKind.Remove && spawned.TryGetValue(external.Body, out Birth? body) && external.Time >= body.Since)
        {
            body.Removed = SimTime.Min(body.Removed, external.Time); // a removal before the spawn removed nothing
        }
    }

    /// <summary>Retracts an own event that was refused.</summary>
    internal void Retract(in ExternalEvent external)
    {
        if (external.Kind == EventKind.Spawn)
        {
            spawned.Remove(external.Body);
        }
        else if (external.Kind == EventKind.Remove && spawned.TryGetValue(external.Body, out Birth? body) && body.Removed == external.Time)
        {
            body.Removed = SimTime.MaxValue;
        }
    }

    /// <summary>The surface speed of a spinning spawn; friction turns it into linear speed.</summary>
    private static double SurfaceSpeed(in ExternalEvent spawn) => spawn.Spin.Length * spawn.Spec.Radius;

    /// <summary>
    /// Returns the speed of the body after the event, and before it. For an impulse and a lagging hold it uses the world as known now.
    /// </summary>
    private double SpeedAfter(in ExternalEvent external, Simulation world, out double before)
    {
        before = 0;
        if (external.Kind == EventKind.HoldKeyframe)
        {
            return Math.Max(external.Velocity.Length, SpeedOfCatchingUp(external, world));
        }

        if (external.Kind != EventKind.Impulse)
        {
            return external.Kind == EventKind.Remove ? 0 : external.Velocity.Length;
        }

        if (external.Body.Peer == external.Peer && external.Body.Sequence > external.Sequence)
        {
            return double.PositiveInfinity; // on a body it spawns later, of any mass
        }

        BodyState state = default;
        if (external.Time >= world.HistoryEdge && external.Time <= world.Horizon)
        {
            world.TryRead(external.Body, external.Time, out state);
        }

        before = state.Velocity.Length;
        return (state.Velocity + (external.Velocity / MassOf(external.Body, world))).Length;
    }

    /// <summary>The mean speed at which a held body catches up with the hand; 0 if this peer does not hold it.</summary>
    private static double SpeedOfCatchingUp(in ExternalEvent external, Simulation world)
    {
        bool isKnown = external.Time >= world.HistoryEdge && external.Time <= world.Horizon;
        return isKnown && world.TryReadHold(external.Body, external.Time, out Hold hold) && hold.Peer == external.Peer
            && world.TryRead(external.Body, external.Time, out BodyState state)
            ? (external.Position - hold.Offset - state.Position).Length / HandPath.Settles.ToSeconds()
            : 0;
    }

    /// <summary>The mass of a body in kg; 1 for an unknown body, because an event may arrive before the spawn of its body.</summary>
    private double MassOf(BodyId body, Simulation world)
    {
        if (body.Peer == 0 && body.Sequence == 0 && body.Index < world.Scene.Bodies.Count)
        {
            return world.Scene.Bodies[body.Index].Spec.Mass;
        }

        double mass = spawned.TryGetValue(body, out Birth? known) ? known.Mass : world.SpecOf(body).Mass;
        return mass > 0 ? mass : 1;
    }

    /// <summary>Forgets bodies removed before that time; no event that is still accepted can refer to them.</summary>
    private void ForgetBefore(SimTime time)
    {
        if (spawned.Count >= options.MaxSpawned)
        {
            foreach (BodyId gone in spawned.Where(s => s.Value.Removed < time).Select(s => s.Key).ToList())
            {
                spawned.Remove(gone);
            }
        }
    }

    private sealed class Birth
    {
        internal Birth(double mass, SimTime since)
        {
            Mass = mass;
            Since = since;
        }

        internal double Mass { get; }

        internal SimTime Since { get; }

        internal SimTime Removed { get; set; } = SimTime.MaxValue;
    }
}
