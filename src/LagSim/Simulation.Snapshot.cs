using System;
using System.Collections.Generic;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <content>Snapshots: the whole world at an instant, to go on from elsewhere.</content>
public sealed partial class Simulation
{
    /// <summary>Goes on from a snapshot of a world of this scene: the same events give the same bits as in the world that it was taken of.</summary>
    /// <param name="scene">The scene that the snapshot's world has.</param>
    /// <param name="snapshot">From where to go on. Earlier events are in it; they are <see cref="SubmitResult.TooOld"/>.</param>
    /// <param name="options">As of a new world, but for <see cref="SimulationOptions.Start"/>, which the snapshot tells.</param>
    /// <exception cref="ArgumentNullException">The scene or the snapshot is missing.</exception>
    /// <exception cref="SceneException">The snapshot holds a value that cannot be of a world of this scene; the sentence names it.</exception>
    /// <exception cref="SimulationException">It cannot be simulated.</exception>
    public Simulation(Scene scene, WorldSnapshot snapshot, SimulationOptions? options = null)
        : this(Checked(scene, snapshot), options ??= new SimulationOptions(), snapshot.Start, snapshot.Time, snapshot.BodyArray.Length)
    {
        foreach (ref readonly BodySnapshot body in snapshot.BodyArray.AsSpan())
        {
            int slot = AddBody(body.Id, body.Spec);
            collapseRule.HasLosses |= body.Spec.Restitution < 1 || body.Segment.Law == MotionLaw.Held;
            timelines.Append(slot, body.Id, body.Opened, body.Segment, body.Dense, body.Hold, body.SpinPath);
            if (body.Segment.IsOfIsland)
            {
                int piece = timelines.Last(slot);
                timelines.BeginMember(piece, body.Centre, body.StillSince);
                foreach (LastingContact contact in body.ContactArray)
                {
                    timelines.AddContact(piece, contact);
                }

                timelines.EndMember(piece, body.Id);
            }
        }

        timelines.ContinueFrom(snapshot.EventHash);
        PredictAll();
        AdvanceTo(snapshot.Time);
        twin = healing == HealingMode.SyncTest ? new Simulation(scene, snapshot, options.FullyRolledBack()) : null;
    }

    private static Scene Checked(Scene scene, WorldSnapshot snapshot)
    {
        _ = scene ?? throw new ArgumentNullException(nameof(scene));
        SnapshotCheck.Throw(snapshot ?? throw new ArgumentNullException(nameof(snapshot)), scene);
        return scene;
    }

    /// <summary>The world after everything before <paramref name="time"/>. Changes nothing. Cost: the segments of all bodies since then.</summary>
    /// <exception cref="ArgumentOutOfRangeException">
    /// The time is outside <see cref="HistoryEdge"/> to <see cref="SimulatedTo"/>, or not after the start.
    /// </exception>
    public WorldSnapshot Snapshot(SimTime time)
    {
        ThrowIfFaulted();
        if (time < HistoryEdge || time > SimulatedTo || time <= Start)
        {
            throw new ArgumentOutOfRangeException(
                nameof(time), time.ToShortString(), $"A snapshot can be taken from {SimTime.Max(HistoryEdge, Start + SimDuration.OneTick).ToShortString()} to"
                    + $" {SimulatedTo.ToShortString()}, up to where the world is simulated.");
        }

        SimTime last = time - SimDuration.OneTick;
        List<BodySnapshot> there = new();
        foreach (int slot in bodies)
        {
            int at = timelines.At(slot, last);
            if (at != TimelineStore.None && timelines.Segment(at).IsPresent)
            {
                bool isMember = paths.IsMember(at);
                there.Add(new BodySnapshot(
                    bodies.Id(slot), bodies.Spec(slot), timelines.Key(at), timelines.Segment(at), timelines.Dense(at), timelines.HoldOf(at), timelines.SpinOf(at),
                    isMember ? timelines.CentreOf(at) : default, isMember ? timelines.StillSince(at) : default, timelines.ContactsOf(at)));
            }
        }

        return new WorldSnapshot(Start, time, EventHashUpTo(last), there.ToArray());
    }
}
