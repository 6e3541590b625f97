using System;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Tests.Faults;
using LagSim.Time;
using Xunit;
using static LagSim.Tests.TestWorlds;

namespace LagSim.Tests.Contacts;

/// <summary>Rules of docs/CONTACT.md that a speed decides: what they hold, and what comes without them. The control of each is another scale, handed in.</summary>
public sealed class ContactRuleTests
{
    private const double Tolerance = 1e-3; // the contact tolerance of the heap
    private const int Balls = 28;

    /// <summary>Rule 8: a heavy ball that falls on a heap is stopped by all of it. The control has its impact end at those that it strikes.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Impact_OnAHeap_GoesOnThroughIt(bool isCutShort)
    {
        Scene scene = Heap();
        Simulation simulation = new(scene, Options(new FaultyContactScale(scene) { CutsImpactsShort = isCutShort }));
        Assert.Equal(isCutShort, Deepest(simulation, 2) > Tolerance);
        Assert.Equal(isCutShort, simulation.ImpactsProcessed > 1_000);
    }

    /// <summary>
    /// Rule 8: also from what its last solution has changed. Here that is most of it, for sweeps pass on little of what is a hundred
    /// thousand times as heavy as the heap's balls. The control is by sweeps alone. (With an end at the first solution it was 2.9 mm.)
    /// </summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Impact_OfWhatIsVeryHeavy_GoesOnThroughTheHeap(bool sweepsAlone)
    {
        FaultyEngineParts parts = new() { Rules = new FaultySolverRules { SweepsAlone = sweepsAlone } };
        Simulation simulation = new(Heap(heavy: 1e5), new SimulationOptions().WithParts(parts));
        Assert.Equal(sweepsAlone, Deepest(simulation, 1) > 0.05 * Tolerance);
    }

    private static double Deepest(Simulation simulation, double until)
    {
        double deepest = 0;
        for (double t = 0.002; t <= until; t += 0.002)
        {
            simulation.AdvanceTo(At(t));
            deepest = Math.Max(deepest, -MinGap(simulation, At(t)));
        }

        return deepest;
    }

    /// <summary>Rule 8: friction and rebound may make energy where contacts share bodies; without the rebound they do not. The control is with it.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Impact_SolvedAgainWithoutRebound_GainsNoEnergy(bool rebounds)
    {
        double gain = 0;
        for (int seed = 0; seed < 200; seed++)
        {
            ContactProblem problem = ContactSolverTests.Draw(seed, 0.6, 0);
            for (int i = 0; i < problem.ContactCount; i++)
            {
                ref SolverContact c = ref problem.Contacts[i];
                c.Target = -0.9 * Math.Min(0, ContactSolver.Opening(problem, c));
            }

            if (!rebounds)
            {
                problem.DropRebounds();
            }

            double before = problem.KineticEnergy();
            ContactSolver.Solve(problem, 1e-9, 20_000);
            gain = Math.Max(gain, (problem.KineticEnergy() - before) / before);
        }

        Assert.Equal(rebounds, gain > 1e-6);
    }

    /// <summary>Rule 12: what holds, and closes no faster than impacts leave it, is not struck within the step. The control strikes all that closes.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Contact_ThatClosesAsSlowlyAsImpactsLeaveIt_IsNotStruck(bool isStruck)
    {
        Scene scene = Heap();
        Simulation simulation = new(scene, Options(new FaultyContactScale(scene) { StrikesWhatIsSlow = isStruck }));
        long most = 10_000;
        simulation.TryAdvanceTo(At(2), ref most);
        Assert.Equal(isStruck, simulation.ImpactsProcessed > 2_000);
    }

    /// <summary>Rule 14: what closes again in the instant in which it bounced bounces no second time. The control has it bounce as often as it closes.</summary>
    [Theory]
    [InlineData(0.0)]
    [InlineData(0.05)]
    public void Bodies_ThatCloseAgainInOneInstant_GoOnTogether(double e)
    {
        long storm = Storm(e, neverCollapses: false);
        Assert.InRange(storm, 10, 500);
        Assert.True(Storm(e, neverCollapses: true) > 3 * storm);
    }

    /// <summary>How many events take eight balls in a box to 20 s, or 20,000 if they do not.</summary>
    private static long Storm(double e, bool neverCollapses)
    {
        Random random = new(5);
        double Any() => (2 * random.NextDouble()) - 1;
        SceneBuilder builder = new SceneBuilder("room").WithGravity(Vector3D.Zero).AddPlane("west", V(1), -2.0).AddPlane("east", V(-1), -2.0)
            .AddPlane("floor", V(0, 1), -2.0).AddPlane("lid", V(0, -1), -2.0).AddPlane("north", V(0, 0, 1), -2.0).AddPlane("south", V(0, 0, -1), -2.0);
        for (int n = 0; n < 8; n++)
        {
            BodySpec ball = new(0.5, 1 + (2 * random.NextDouble()), e);
            Vector3D place = V((n % 2 * 2) - 1 + (0.3 * Any()), (n / 2 % 2 * 2) - 1 + (0.3 * Any()), (n / 4 * 2) - 1 + (0.3 * Any()));
            builder.AddBody($"ball {n}", ball, place, V(3 * Any(), 3 * Any(), 3 * Any()));
        }

        FaultyEngineParts parts = new() { NeverCollapses = neverCollapses };
        Simulation simulation = new(builder.Build(), new SimulationOptions().WithParts(parts));
        long most = 20_000;
        simulation.TryAdvanceTo(At(20), ref most);
        return 20_000 - most;
    }

    private static SimulationOptions Options(ContactScale scale) =>
        new SimulationOptions(default, SimDuration.FromSeconds(10)).WithParts(new FaultyEngineParts { Scale = scale });

    /// <summary>27 balls in a pit, and a heavy one that falls on them.</summary>
    private static Scene Heap(double heavy = 10)
    {
        Random random = new(3);
        const double half = 0.35;
        SceneBuilder builder = new SceneBuilder("heap").WithContactTolerance(Tolerance).AddPlane("floor", Vector3D.Up, 0.0)
            .AddPlane("west", V(1), -half).AddPlane("east", V(-1), -half).AddPlane("north", V(0, 0, 1), -half).AddPlane("south", V(0, 0, -1), -half);
        for (int n = 0; n < Balls - 1; n++)
        {
            double x = (((n % 3) - 1) * 0.22) + (0.01 * random.NextDouble()), z = (((n / 3 % 3) - 1) * 0.22) + (0.01 * random.NextDouble());
            builder.AddBody($"ball {n}", new BodySpec(0.1, 1, 0.2, friction: 0.3), V(x, 0.15 + (0.25 * (n / 9)), z));
        }

        return builder.AddBody("heavy", new BodySpec(0.15, heavy, 0.2, friction: 0.3), V(0.01, 3, 0.02)).Build();
    }
}
