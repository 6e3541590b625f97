using System;
using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;
using static LagSim.Harness.Verification.Hard.HardWorlds;

namespace LagSim.Harness.Verification.Hard;

/// <summary>
/// A sphere between two planes with friction rolls or slips down along them: two contacts with friction at once, with a smaller arm than
/// the radius.
/// </summary>
/// <remarks>
/// The planes rise at an angle t to either side, and the groove falls at an angle b. Each contact is cos(t) of the radius below the axis,
/// and the two normal forces add up to 1 / cos(t) times the load on the groove. So it rolls with g sin b / (1 + 2/5 / cos² t), which needs
/// friction of f cos(t) / (g cos b), where f is g sin b less that; else it slips with g sin b - mu g cos b / cos t.
/// </remarks>
internal sealed class GrooveCase : IHardCase
{
    private const double Radius = 0.5;
    private const double Seconds = 2;
    private const double Tolerance = 1e-6;

    /// <summary>
    /// The fraction of the tolerance by which bounds allow a contact to close in a step: ten times what the sweeps leave.
    /// </summary>
    private const double SweepPart = 0.05;

    private const double Coarse = 1.0 / 256;

    /// <summary>sin b and cos b of a fall of 3 in 4.</summary>
    private const double Sine = 0.6, Cosine = 0.8;

    public string Name => "groove";

    public string Title => "a sphere wedged between two planes with friction: rolls or slips down along them";

    public IEnumerable<HardRow> Rows(HardContext context)
    {
        foreach (double half in context.Sizes([Math.PI / 4], [0.2, Math.PI / 4, 1.2]))
        {
            foreach (double nearness in context.Sizes([0.1, -0.1], [1, 0.1, 1e-3, -1e-3, -0.1, -0.9]))
            {
                foreach (HardRow row in Rows(context, half, nearness, nearness))
                {
                    yield return row;
                }
            }
        }

        yield return Order(context, 1.0 / 4096);
    }

    public IEnumerable<HardRow> Controls(HardContext context)
    {
        foreach (HardRow row in Rows(context, Math.PI / 4, -1e-3, 1e-3))
        {
            yield return row with { Note = "what rolls taken for what slips" };
        }

        yield return Order(context, Coarse) with { Note = ContactSteps.SameSteps };
    }

    /// <summary>
    /// Where the sides meet at a right angle, sweeps converge at once, and the only error is the friction of the first half step.
    /// </summary>
    private HardRow Order(HardContext context, double fine)
    {
        double[] places = [.. new[] { Coarse, fine }
            .Select(step => Rows(context, Math.PI / 4, -0.1, -0.1, ContactSteps.ToleranceOf(step)).First().Error)];
        return ContactSteps.Order(
            Name, "sides at a right angle, friction -0.1 of what rolling needs, place", places[0], places[1], 16, 1, 0.05,
            "the next order is a step over the time that is watched, a thousandth, of this one");
    }

    private IEnumerable<HardRow> Rows(HardContext context, double half, double nearness, double actual, double tolerance = Tolerance)
    {
        double arm = Math.Cos(half), rolling = Gravity * Sine / (1 + (0.4 / (arm * arm)));
        double needed = ((Gravity * Sine) - rolling) * arm / (Gravity * Cosine), mu = needed * (1 + nearness);
        double a = nearness >= 0 ? rolling : (Gravity * Sine) - (mu * Gravity * Cosine / arm);
        double turning = nearness >= 0 ? a / (Radius * arm) : 2.5 * mu * Gravity * Cosine / Radius;
        Scene scene = new SceneBuilder("groove").WithContactTolerance(tolerance).WithGravity(V(0, -Gravity * Cosine, Gravity * Sine))
            .AddPlane("left", V(Math.Sin(half), arm), 0.0).AddPlane("right", V(-Math.Sin(half), arm), 0.0)
            .AddBody("ball", new BodySpec(Radius, 3, 0, friction: needed * (1 + actual)), V(0, Radius / arm)).Build();
        double step = ContactSteps.Step(tolerance), brake = ((Gravity * Sine) - rolling) * Math.Min(1, 1 + nearness);
        double speed = (2 * SweepPart * tolerance / step) + (brake * step / 2);
        Simulation simulation = context.Run(scene, Seconds);
        BodyState state = ContactSteps.AtTick(simulation, 0, Seconds, step);
        double way = a * Seconds * Seconds / 2;
        string size = FormattableString.Invariant($"sides at {half:0.###} rad, friction {nearness:+0.###;-0.###} of what rolling needs");
        string law = nearness >= 0 ? "g sin b/(1 + 2/5/cos^2 t)" : "g sin b - mu g cos b/cos t";
        yield return new HardRow(
            Name, size, (state.Position - V(0, Radius / arm, way)).Length, "position_m", (speed * Seconds) + tolerance,
            "as a speed, for as long as is watched, 0.05 d a step of each of two contacts, as much as it may leave: what one lacks in a step it"
                + " has in the next;"
                + " the friction of the first half step, in which there is no slip yet to be along; and d, 1e-6 m",
            law + " t^2/2");
        yield return new HardRow(
            Name, size, (state.Spin - V(turning * Seconds)).Length, "spin_rad_per_s", 2.5 * speed / Radius,
            "5/2 of that speed, over the radius: at a tick, where the mean of both sides is off by nothing"
                + " else", nearness >= 0 ? law + " t/(r cos t)" : "5/2 mu g cos b t/r");
    }
}
