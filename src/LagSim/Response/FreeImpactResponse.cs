using System;
using LagSim.Contacts;
using LagSim.Events;
using LagSim.Islands;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Response;

/// <summary>Solves an impact that ends where it is struck: rebounds, friction, and the end of a collapse.</summary>
internal sealed class FreeImpactResponse(
    Scene scene, BodyTable bodies, TimelineStore timelines, ContactGraph graph, ContactScale scale, CaptureRule capture, CollapseRule collapse)
{
    private readonly StaticSurfaces surfaces = scene.Surfaces;
    private readonly ImpactSolver solver = new();
    private readonly ImpactFriction friction = new();
    private readonly PoissonImpact poisson = new();
    private bool givesBack; // whether the impact of the graph is of a closed instant, and is solved already
    private double[] coefficients = Array.Empty<double>();

    /// <summary>Sets the rebound of each contact of the graph, and whether it persists from here on.</summary>
    internal void SetTargets(bool collapses, in EventKey key)
    {
        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref ContactPoint c = ref graph.Contacts[i];
            c.Normal = graph.NormalOf(c);
            double closing = Math.Max(0, -ImpactSolver.Opening(c, graph.Velocities));
            c.Target = collapses && collapse.WasStruck(c, key.Time) ? 0 : graph.RestitutionOf(c) * closing;
        }

        givesBack = collapses && CollapseRule.GivesBack(key) && !graph.HasHand();
        if (givesBack)
        {
            GiveBack();
        }

        for (int i = 0; i < graph.ContactCount; i++)
        {
            ref ContactPoint c = ref graph.Contacts[i];
            c.Lasts = capture.IsLast(c, graph.RestitutionOf(c), c.Target, key.Time)
                || (collapses && c.Target <= scale.SweepSpeed && graph.HasMember(c) && collapse.WasStruck(c, key.Time));
            c.Target = c.Lasts ? 0 : c.Target;
        }
    }

    /// <summary>Solves the impact of the graph, with what carries its bodies.</summary>
    internal void Resolve(bool collapses)
    {
        int struck = graph.ContactCount;
        AddSupports();
        if (givesBack)
        {
            poisson.Apply(graph.Contacts, graph.Masses, graph.Velocities);
        }
        else
        {
            solver.Solve(graph.Contacts, graph.Masses, graph.Velocities);
        }

        if (!collapses)
        {
            SolveFriction(); // a collapse is only to end
        }
        else if (collapse.StillCloses())
        {
            collapse.GoOnTogether();
        }

        LimitSpeeds();
        graph.KeepContacts(struck);
    }

    /// <summary>Solves the impact of bodies in free flight, which nothing carries.</summary>
    internal void ResolveAlone()
    {
        solver.Solve(graph.Contacts, graph.Masses, graph.Velocities);
        SolveFriction();
        LimitSpeeds();
    }

    /// <summary>
    /// A body that an impact would make faster than <see cref="Limits.MaxReboundSpeed"/> leaves it at that speed, in the same direction: a
    /// rule of the world, the same bits on every peer. A velocity that is not finite becomes no finite one, and its body is lost (<see cref="LossReason.NotFinite"/>).
    /// </summary>
    internal void LimitSpeeds()
    {
        double limit = Limits.MaxReboundSpeed(scene.SmallestRadius);
        Span<Vector3D> velocities = graph.Velocities;
        for (int i = 0; i < velocities.Length; i++)
        {
            double speed = velocities[i].Length;
            if (speed > limit && !double.IsPositiveInfinity(graph.Masses[i]))
            {
                velocities[i] *= limit / speed;
            }
        }
    }

    /// <summary>Applies friction in the current impact, if any of its bodies has some.</summary>
    private void SolveFriction()
    {
        bool rubs = false;
        for (int i = 0; i < graph.BodyCount; i++)
        {
            rubs |= bodies.Spec(graph.Slots[i]).Friction > 0;
        }

        if (!rubs)
        {
            return;
        }

        if (graph.ContactCount > coefficients.Length)
        {
            coefficients = new double[graph.ContactCount * 2];
        }

        for (int i = 0; i < graph.ContactCount; i++)
        {
            coefficients[i] = graph.FrictionOf(graph.Contacts[i]);
        }

        friction.Solve(
            graph.Contacts, coefficients.AsSpan(0, graph.ContactCount), graph.Masses, graph.Radii,
            graph.Velocities, graph.Spins);
    }

    /// <summary>
    /// A body that is carried stays carried while it is hit: its supports push back as far as they must, and give nothing.
    /// </summary>
    private void AddSupports()
    {
        for (int i = 0; i < graph.BodyCount; i++)
        {
            SupportSet supports = timelines.Segment(timelines.Last(graph.Slots[i])).Supports;
            for (int k = 0; k < supports.Count; k++)
            {
                if (!graph.HasContact(i, supports[k]))
                {
                    graph.AddContact(new ContactPoint(i, ContactPoint.Static, supports[k], default)
                    {
                        Normal = surfaces.Plane(supports[k]).Normal,
                    });
                }
            }
        }
    }

    /// <summary>
    /// What a closed instant gives back (<see cref="PoissonImpact"/>). What carries a body is pressed with the others, and gives nothing.
    /// </summary>
    private void GiveBack()
    {
        int struck = graph.ContactCount;
        AddSupports();
        int count = graph.ContactCount;
        Span<double> restitutions = count <= 64 ? stackalloc double[count] : new double[count];
        for (int i = 0; i < count; i++)
        {
            restitutions[i] = i < struck ? graph.RestitutionOf(graph.Contacts[i]) : 0;
        }

        poisson.Solve(graph.Contacts, restitutions, graph.Masses, graph.Velocities);
        graph.KeepContacts(struck);
    }
}
