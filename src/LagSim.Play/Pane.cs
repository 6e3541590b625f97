using System;
using System.Collections.Generic;
using LagSim.Events;
using LagSim.Hosting;
using LagSim.Net.Display;
using LagSim.Net.Sessions;
using LagSim.Net.Strategies;
using LagSim.Scenes;
using LagSim.Time;

namespace LagSim.Play;

/// <summary>One peer of a playground, as a person sees it: where its bodies are drawn, and what lag cost it.</summary>
/// <remarks>Not thread-safe.</remarks>
internal sealed class Pane
{
    private readonly PlayScene scene;
    private readonly bool isSmooth;
    private readonly HandOfPerson hand;
    private readonly RewrittenGlow glow = new();
    private readonly DrawnPlace[] places;
    private LiveWorld? watched;
    private HealTotals healed;
    private DisplayOffsets display;
    private double shownSeconds;

    internal Pane(int number, Session session, LateEventStrategy strategy, PlayScene scene, bool isSmooth, Action wake)
    {
        Number = number;
        Session = session;
        Strategy = strategy;
        this.scene = scene;
        this.isSmooth = isSmooth;
        hand = new HandOfPerson(session, scene, wake);
        places = new DrawnPlace[scene.Scene.Bodies.Count];
        display = new DisplayOffsets(scene.Scene);
    }

    /// <summary>Its number: 0 is the host.</summary>
    internal int Number { get; }

    /// <summary>The peer.</summary>
    internal Session Session { get; }

    /// <summary>What it does with late events.</summary>
    internal LateEventStrategy Strategy { get; }

    /// <summary>Its player, in a scene of air hockey; else null.</summary>
    internal AirHockeyPlayer? Player { get; set; }

    /// <summary>What it sees of the match, in a scene of air hockey; else null.</summary>
    internal AirHockeyBoard? Board { get; set; }

    /// <summary>How many heals there were.</summary>
    internal long Heals => healed.Heals;

    /// <summary>How many events they simulated again.</summary>
    internal long EventsRerun => healed.Events;

    /// <summary>How many bodies they predicted again.</summary>
    internal long BodiesRewound => healed.Bodies;

    /// <summary>How far the body that is furthest off is drawn from where it is in truth, in metres. One in the hand of the person at this
    /// pane is where the hand is: of the hand the world knows keyframes.</summary>
    internal double Error { get; private set; }

    /// <summary>Where the bodies of the scene are drawn, in their order.</summary>
    internal ReadOnlySpan<DrawnPlace> Places => places;

    /// <summary>Whether a person holds a body in this pane.</summary>
    internal bool IsHolding => hand.IsHolding;

    /// <summary>Finds what is drawn now.</summary>
    /// <param name="truth">The world without delay.</param>
    /// <param name="seconds">How much real time has passed since the last frame.</param>
    internal void Draw(Truth truth, double seconds)
    {
        if (Session.World is not LiveWorld world)
        {
            return;
        }

        Watch(world);
        SimTime now = Session.SharedTime.Now; // as well as this peer knows it
        shownSeconds += seconds;
        display.Update(world.RenderSnapshots.Latest(), Session.DisplayTime);
        Player?.ShowHand(display);
        Board?.Look(display);
        Error = 0;
        for (int n = 0; n < places.Length; n++)
        {
            bool isThere = display.TryRead(BodyId.OfScene(n), out DrawnBody drawn);
            truth.TryRead(BodyId.OfScene(n), now, out BodyState real);
            Vector3D shown = isSmooth || drawn.IsInHand ? drawn.Position : drawn.State.Position;
            double shine = glow.Of(BodyId.OfScene(n), drawn.Jump > 0, shownSeconds);
            places[n] = new DrawnPlace(isThere, scene.ToView(shown), scene.ToView(real.Position), shine, drawn.IsInHand);
            Error = Math.Max(Error, isThere && !drawn.IsInHand ? (shown - real.Position).Length : 0);
        }
    }

    /// <summary>A person takes the body that is drawn at a point, or close by.</summary>
    /// <returns>What was done; null if there is no body, or it could not be taken.</returns>
    internal ExternalEvent? Grab(double x, double y, double reach)
    {
        int nearest = Nearest(x, y, reach);
        return nearest < 0 || Session.World is null || Player is not null ? null : hand.Take(BodyId.OfScene(nearest));
    }

    /// <summary>The hand moves; see <see cref="HandOfPerson.Move"/>.</summary>
    internal ExternalEvent? MoveHand(double x, double y, double velocityX, double velocityY) =>
        hand.Move(display, x, y, velocityX, velocityY);

    /// <summary>The hand lets go; see <see cref="HandOfPerson.Release"/>.</summary>
    internal ExternalEvent? Release(double velocityX, double velocityY) => hand.Release(display, velocityX, velocityY);

    /// <summary>A player gives a body a velocity; see <see cref="HandOfPerson.Strike"/>.</summary>
    internal ExternalEvent? Strike(int body, double velocityX, double velocityY) =>
        hand.Strike(BodyId.OfScene(body), velocityX, velocityY);

    /// <summary>Finds where the bodies are in this world at any instant of its window, instead of what is drawn now.</summary>
    /// <remarks>The error is not a number where the world without delay does not have that instant.</remarks>
    internal void DrawAt(Truth truth, SimTime time)
    {
        Simulation? world = Session.World?.Simulation;
        bool isKnown = world is not null && time >= world.HistoryEdge && time <= world.Horizon, isTrue = truth.Covers(time);
        Error = isTrue ? 0 : double.NaN;
        for (int n = 0; n < places.Length; n++)
        {
            BodyState state = default, real = default;
            bool isThere = isKnown && world!.TryRead(BodyId.OfScene(n), time, out state);
            bool isReal = isTrue && truth.TryRead(BodyId.OfScene(n), time, out real);
            (double X, double Y) drawn = scene.ToView(state.Position);
            places[n] = new DrawnPlace(isThere, drawn, isReal ? scene.ToView(real.Position) : drawn, 0, false);
            Error = isThere && isReal ? Math.Max(Error, (state.Position - real.Position).Length) : Error;
        }
    }

    /// <summary>Appends the paths of all bodies of the scene, in their order, over a span of the window; see
    /// <see cref="PathSampler.Append"/>.</summary>
    internal void AppendPaths(
        SimTime oldest, SimTime newest, SimTime now, (int Count, bool WithBounces) points, List<double> into)
    {
        for (int n = 0; n < places.Length; n++)
        {
            if (Session.World?.Simulation is Simulation world)
            {
                PathSampler.Append(world, scene, BodyId.OfScene(n), (oldest, newest), now, points, into);
            }
            else
            {
                into.Add(0);
            }
        }
    }

    /// <summary>Does an action; see <see cref="HandOfPerson.Do"/>.</summary>
    internal ExternalEvent? Do(in PlayerAction action) => hand.Do(action);

    /// <summary>The hash of its state at a time; null if it does not have that time.</summary>
    internal ulong? HashAt(SimTime time)
    {
        Simulation? world = Session.World?.Simulation;
        return world is not null && time >= world.HistoryEdge && time <= world.Horizon ? world.StateHash(time) : null;
    }

    private int Nearest(double x, double y, double reach)
    {
        int nearest = -1;
        double least = double.PositiveInfinity;
        for (int n = 0; n < places.Length; n++)
        {
            double dx = places[n].Drawn.X - x, dy = places[n].Drawn.Y - y;
            double gap = Math.Sqrt((dx * dx) + (dy * dy)) - scene.Scene.Bodies[n].Spec.Radius;
            if (places[n].IsThere && gap <= reach && gap < least)
            {
                (nearest, least) = (n, gap);
            }
        }

        return nearest;
    }

    /// <summary>A peer that has got a fresh copy has another world.</summary>
    private void Watch(LiveWorld world)
    {
        if (ReferenceEquals(watched, world))
        {
            return;
        }

        watched = world;
        display = new DisplayOffsets(scene.Scene);
        world.Simulation.Healed += heal => healed = healed.And(heal);
    }
}
