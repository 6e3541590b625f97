using LagSim.Scenes;

namespace LagSim.Events;

/// <summary>
/// The door: what an external event must satisfy before it may enter the world, whenever that is asked. What stops a body hangs on the filter
/// that it has when the event's time comes, so a place inside of static geometry is dealt with there.
/// </summary>
public static class ExternalEventCheck
{
    /// <summary>Throws if the event may not enter a world of this scene.</summary>
    /// <exception cref="SceneException">The sentence names the value and what is allowed.</exception>
    public static void Throw(in ExternalEvent external, Scene scene)
    {
        if (scene is null)
        {
            throw new System.ArgumentNullException(nameof(scene));
        }

        if (external.Peer == SceneRules.Peer && scene.Rules is not null)
        {
            throw new SceneException($"{external} is of peer {SceneRules.Peer}; in a scene with rules that number stands for them.");
        }

        if (external.Time > Limits.LatestTime)
        {
            throw new SceneException($"The time of {external} is {external.Time.ToShortString()}; a world lasts until {Limits.LatestTime.ToShortString()} at most.");
        }

        ThrowIfUnfit(external, scene);
    }

    /// <summary>Throws if the values of an event, or of what rules do, may not enter a world of this scene.</summary>
    internal static void ThrowIfUnfit(in ExternalEvent external, Scene scene)
    {
        Subject whose = new(external);
        if (EventKinds.IsForRules(external.Kind))
        {
            CheckTold(external, scene);
            return;
        }

        if (!EventKinds.IsExternal(external.Kind))
        {
            throw new SceneException($"{external.Kind} is not an external event.");
        }

        if (scene.Box.Exists && external.Kind is >= EventKind.Grab and <= EventKind.Release)
        {
            throw new SceneException($"{external.Kind} of body {external.Body} is no event of this scene: in a periodic box nothing is held.");
        }

        if (external.Sequence == 0)
        {
            throw new SceneException($"The sequence number of {whose} is 0; a peer counts its events from 1.");
        }

        if (external.WhenOccupied > WhenOccupied.Beside)
        {
            throw new SceneException(
                $"What {whose} does where another body is, is {(byte)external.WhenOccupied}; it must be {nameof(WhenOccupied.Overlap)} (put it there),"
                    + $" {nameof(WhenOccupied.Skip)} (do nothing) or {nameof(WhenOccupied.Beside)} (put it beside).");
        }

        CheckKnown(external, scene, whose);
        Limits.CheckPosition(external.Position, whose);
        if (external.Kind == EventKind.Impulse)
        {
            Limits.Components(external.Velocity, double.MaxValue, whose, "impulse", "N s");
        }
        else
        {
            Limits.CheckVelocity(external.Velocity, scene.SmallestRadius, whose);
        }

        Limits.InRange(external.MaxForce, 0, Limits.MaxStrength, whose, "greatest force", "N (0: the default)");
        Limits.InRange(external.MaxPower, 0, Limits.MaxStrength, whose, "greatest power", "W (0: the default)");
        bool isOfScene = external.Body.Peer == 0 && external.Body.Sequence == 0;
        if (isOfScene && external.Kind is (EventKind.SetVelocity or EventKind.Teleport or EventKind.Release))
        {
            Limits.CheckDrag(external.Velocity, scene.BodyArray[external.Body.Index].Spec, whose, scene.ForceArray);
        }

        if (external.Kind == EventKind.Spawn)
        {
            CheckSpawn(external, scene, whose);
        }
        else if (external.Kind == EventKind.Teleport && isOfScene)
        {
            Limits.CheckPlaceInBox(external.Position, scene.Box, whose);
            Limits.CheckCentres(external.Position, scene.BodyArray[external.Body.Index].Spec, whose, scene.ForceArray);
        }
        else if (external.Kind == EventKind.Teleport)
        {
            Limits.CheckPlaceInBox(external.Position, scene.Box, whose);
        }
    }

    private static void CheckTold(in ExternalEvent external, Scene scene)
    {
        if (scene.Rules is null)
        {
            throw new SceneException($"{external} is no event of this scene: it has no rules that could hear it.");
        }

        if (external.PlayerEvent is not null && !scene.Rules.HearsPlayers)
        {
            throw new SceneException($"{external} is no event of this scene: its rules '{scene.Rules}' do not hear of players (HearsPlayers).");
        }

        if (external.Sequence == 0)
        {
            throw new SceneException($"The sequence number of {(object?)external.Command ?? external.PlayerEvent} is 0; a peer counts its events from 1.");
        }
    }

    private static void CheckKnown(in ExternalEvent external, Scene scene, Subject whose)
    {
        bool ofScene = external.Body.Peer == 0 && external.Body.Sequence == 0;
        if (ofScene && external.Body.Index >= scene.BodyArray.Length)
        {
            throw new SceneException($"There is no such body for {whose}: the scene has {scene.BodyArray.Length} of its own.");
        }

        if (!ofScene && (external.Body.Index != 0 || external.Body.Sequence == 0))
        {
            throw new SceneException($"There is no such body for {whose}: a spawn makes one body, of index 0, and spawns count from 1.");
        }
    }

    private static void CheckSpawn(in ExternalEvent external, Scene scene, Subject whose)
    {
        Limits.CheckSpec(external.Spec, whose, scene.Gravity, scene.ForceArray);
        if (external.Spec.Radius < scene.SmallestRadius)
        {
            throw new SceneException(scene.Bodies.Count == 0 && scene.SmallestRadius == Limits.MaxRadius
                ? $"The radius of {whose} is {Limits.Text(external.Spec.Radius)} m; a scene without bodies of its own takes none until"
                    + " smallest_radius_m (SceneBuilder.WithSmallestRadius) says how small they may be."
                : $"The radius of {whose} is {Limits.Text(external.Spec.Radius)} m; the scene promises none below {Limits.Text(scene.SmallestRadius)} m,"
                    + " its smallest body unless smallest_radius_m (SceneBuilder.WithSmallestRadius) says less.");
        }

        Limits.CheckDrag(external.Velocity, external.Spec, whose, scene.ForceArray);
        Limits.CheckSpin(external.Spin, external.Spec, scene.SmallestRadius, whose, scene.ForceArray);
        Limits.CheckPlaceInBox(external.Position, scene.Box, whose);
        Limits.CheckCentres(external.Position, external.Spec, whose, scene.ForceArray);
        if (scene.Box.Exists)
        {
            Limits.CheckInBox(external.Spec, external.Position, scene.Box, whose);
        }
    }

    /// <summary>The owner of the value, for an error message. Made into text only then, because the check runs for every event.</summary>
    private readonly struct Subject
    {
        private readonly EventKind kind;
        private readonly BodyId body;

        internal Subject(in ExternalEvent external)
        {
            kind = external.Kind;
            body = external.Body;
        }

        public override string ToString() => $"the {kind} of body {body}";
    }
}
