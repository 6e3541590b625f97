using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>One step of an island: from where its bodies are, and how fast, to the velocities with which they go on for a step of the common clock.</summary>
/// <remarks>
/// <para>Leapfrog: velocities are those of the middle of a step, and a body moves on the chord that they give; at a tick they get what the forces give in a whole step and
/// what the contacts give. So what falls, slides or rolls under constant forces is exact but for rounding at the ticks.</para>
/// <para>Contacts are solved at the velocity level (see <see cref="ContactSolver"/>), those that might close within the step among them: a gap may be used up and no
/// more. Since spheres are convex, chords that keep to that on the line between two centres keep to it everywhere.</para>
/// <para>A pure function of what it is given. Order counts: bodies come in canonical order, and contacts are found in it. Cost: the pairs that are near along one axis,
/// and the contacts times the sweeps.</para>
/// </remarks>
internal sealed class ContactStep
{
    /// <summary>
    /// So many sweeps at most. Then <see cref="NormalsAfterSweeps"/> settles what keeps bodies out of each other; what is left of friction is
    /// an error and no fault, for the next step goes on from the impulses that they got to.
    /// </summary>
    internal const int MostSweeps = 200;

    private readonly StaticSurfaces surfaces;
    private readonly NormalsAfterSweeps normals = new();
    private readonly EnergyLimit limit = new();
    private Member[] members = Array.Empty<Member>();
    private int[] byPlace = Array.Empty<int>();
    private double[] places = Array.Empty<double>();
    private long[] pairs = Array.Empty<long>(); // the lesser body and the greater
    private int pairCount;
    private long[] near = Array.Empty<long>(); // no contacts of the step, but they might come to touch if it makes them faster
    private int nearCount;
    private double fastest; // that the near ones were found for

    internal ContactStep(Scene scene, ContactScale scale)
    {
        surfaces = scene.Surfaces;
        Scale = scale;
    }

    /// <summary>The bodies and contacts of the step, with the velocities of its middle once it is solved.</summary>
    internal ContactProblem Problem { get; } = new();

    internal ContactScale Scale { get; }

    /// <summary>Lets hands push with any force: only a test's negative control sets it.</summary>
    internal bool HandsHaveNoLimit { get; set; }

    /// <summary>Pushes overlap out whatever energy that makes: only a test's negative control sets it.</summary>
    internal bool MayGainEnergy { get; set; }

    /// <summary>Solves by sweeps alone where nothing but their number speaks against it: only a test's negative control sets it.</summary>
    internal bool SweepsAlone { get; set; }

    /// <summary>How many sweeps the last took, and steps of <see cref="NormalsAfterSweeps"/>, which cost as much.</summary>
    internal int Sweeps { get; private set; }

    /// <summary>Begins again, with nobody.</summary>
    internal void Clear() => Problem.Clear();

    /// <summary>Adds a body of the island.</summary>
    /// <param name="spec">What it is.</param>
    /// <param name="position">Where it is at the tick.</param>
    /// <param name="velocity">With which it came: of the middle of the step before.</param>
    /// <param name="gain">What forces add to that until the middle of this step; zero of one in a hand, whose velocity is its mean in the step.</param>
    /// <param name="spin">How it turned.</param>
    /// <param name="isHeld">Whether it is in a hand.</param>
    /// <param name="pull">How hard forces pull it, in m/s².</param>
    internal void AddBody(in BodySpec spec, in Vector3D position, in Vector3D velocity, in Vector3D gain, in Vector3D spin, bool isHeld, double pull = 0)
    {
        int n = Problem.AddBody(isHeld ? double.PositiveInfinity : spec.Mass, spec.Radius, velocity + gain, spin);
        if (n == members.Length)
        {
            Array.Resize(ref members, Problem.Bodies.Length);
            Array.Resize(ref byPlace, Problem.Bodies.Length);
            Array.Resize(ref places, Problem.Bodies.Length);
        }

        members[n] = new Member
        {
            Position = position,
            Free = velocity + gain,
            FreeSpin = spin,
            Friction = spec.Friction,
            Lever = Math.Min(spec.RollingResistance, spec.Friction) * spec.Radius,
            Restitution = spec.Restitution,
            Pull = pull,
        };
    }

    /// <summary>Where a body is at the tick.</summary>
    internal Vector3D PositionOf(int body) => members[body].Position;

    /// <summary>Finds what touches, or might within the step, among the bodies and with static surfaces.</summary>
    internal void FindContacts(double seconds)
    {
        pairCount = 0;
        nearCount = 0;
        FindPairs(seconds);
        Array.Sort(pairs, 0, pairCount);
        int next = 0;
        for (int i = 0; i < Problem.BodyCount; i++)
        {
            FindSurfaces(i, seconds);
            for (; next < pairCount && (int)(pairs[next] >> 32) == i; next++)
            {
                AddPair(i, (int)(uint)pairs[next]);
            }
        }
    }

    /// <summary>
    /// Leaves out what did not hold before and is impacts' affair: elastic contacts, of which they take nothing, but where there is a hand,
    /// which gives and takes; and contacts past which the two go so fast that within the step the surfaces curve away by more than the
    /// tolerance, for then the gap along the line between them does not tell whether they touch.
    /// </summary>
    /// <param name="seconds">How long the step is.</param>
    internal void DropImpacts(double seconds)
    {
        bool hasHand = Problem.HasHand();
        int kept = 0;
        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref Problem.Contacts[i];
            if (c.Held || !((c.IsElastic && !hasHand) || (c.Gap > 0 && CurvesAway(c, seconds))))
            {
                Problem.Contacts[kept++] = c;
            }
            else if (c.Second != ContactPoint.Static)
            {
                Add(ref near, ref nearCount, ((long)c.First << 32) | (uint)c.Second);
            }
        }

        Problem.Keep(kept);
    }

    /// <summary>Solves the step from the impulses that its contacts have.</summary>
    internal void Solve(double seconds, double tolerance)
    {
        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref SolverContact c = ref Problem.Contacts[i];
            c.Target = c.Gap >= 0 ? -c.Gap / seconds : Math.Min(-c.Gap / seconds, Scale.Pull * seconds);
        }

        if (!HandsHaveNoLimit)
        {
            ContactSolver.LimitHands(Problem, Scale.Pull * seconds);
        }

        Sweeps = 0;
        Sweep(tolerance);
    }

    /// <summary>
    /// No step leaves more energy than its bodies came with, what forces give in it included, or than the pull gives them from rest. Each
    /// contact pushes its overlap out no faster than a fall of a step, but in a stack these speeds add up and would throw its top into the
    /// air; so it goes from a solution that pushes nothing out only as far towards the one that does as there is energy for.
    /// </summary>
    internal void LimitEnergy(double seconds, double tolerance)
    {
        double most = Problem.EnergyAt(Scale.Pull * seconds);
        double free = 0;
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            ref readonly SolverBody body = ref Problem.Bodies[b];
            free += body.InverseMass > 0 ? ContactProblem.EnergyOf(body, members[b].Free, members[b].FreeSpin) : 0;
        }

        most = Math.Max(most, free);
        if (Problem.HasHand() || MayGainEnergy || !ContactProblem.IsGain(most, Problem.KineticEnergy()))
        {
            return;
        }

        limit.Remember(Problem);
        Problem.DropRebounds();
        SolveAgain(tolerance);
        limit.GoTowards(Problem, most);
    }

    /// <summary>
    /// Which contacts hold in the step that was solved: those that push, and those that held before and open by less than a quarter of the tolerance, as along what is round, where
    /// a chord leads away a little and comes back.
    /// </summary>
    internal void FindHolding(double seconds)
    {
        FindMeetings(seconds);
        for (int i = 0; i < Problem.ContactCount; i++)
        {
            ref SolverContact c = ref Problem.Contacts[i];
            c.Holds = c.Impulse > 0 || (c.Held && !c.IsElastic && c.Gap + (ContactSolver.Opening(Problem, c) * seconds) <= 0.25 * Scale.Length);
        }
    }

    /// <summary>Has a body come with another velocity, forces included: then the step is to be solved again.</summary>
    internal void Regain(int body, in Vector3D velocity, in Vector3D spin)
    {
        members[body].Free = velocity;
        members[body].FreeSpin = spin;
    }

    /// <summary>Solves the step again from the impulses that it has.</summary>
    internal void SolveAgain(double tolerance)
    {
        BeginAnew();
        Sweep(tolerance);
    }

    private void BeginAnew()
    {
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            Problem.Bodies[b].Velocity = members[b].Free;
            Problem.Bodies[b].Spin = members[b].FreeSpin;
        }
    }

    /// <summary>
    /// Sweeps from the impulses of the last step. If they are too large to add up, the normals are solved first, from none. If sweeps do
    /// not settle, they are solved last.
    /// </summary>
    private void Sweep(double tolerance)
    {
        if (Problem.HasHand() || ContactSolver.CanAddUp(Problem, tolerance))
        {
            ContactSolver.ApplyGiven(Problem);
        }
        else
        {
            Problem.DropImpulses();
            Sweeps += normals.Solve(Problem, tolerance);
        }

        int sweeps = ContactSolver.Solve(Problem, tolerance, MostSweeps);
        Sweeps += sweeps;
        if (!SweepsAlone && NormalsAfterSweeps.IsNeeded(Problem, sweeps, tolerance))
        {
            BeginAnew();
            Sweeps += normals.Solve(Problem, tolerance);
        }
    }

    private void FindSurfaces(int i, double seconds)
    {
        ref readonly Member m = ref members[i];
        ref readonly SolverBody body = ref Problem.Bodies[i];
        if (body.InverseMass == 0)
        {
            return; // nothing static stops a hand
        }

        for (int surface = 0; surface < surfaces.Count; surface++)
        {
            double gap = surfaces.Gap(surface, m.Position, body.Radius);
            Vector3D normal = surfaces.Normal(surface, m.Position);
            double opening = Vector3D.Dot(normal, body.Velocity);
            double restitution = Math.Min(surfaces.Restitution(surface), m.Restitution);
            if (MayTouch(gap, opening, seconds, restitution, m.Pull))
            {
                double friction = Math.Min(surfaces.Friction(surface), m.Friction);
                ref SolverContact c = ref Problem.AddContact(i, ContactPoint.Static, surface, normal, gap, friction, Math.Min(m.Lever, friction * body.Radius));
                c.IsElastic = restitution >= 1;
            }
        }
    }

    /// <summary>
    /// Whether two that pass each other are by more than the tolerance further apart at the end of the step than the plane between them
    /// tells: by s^2 / 2R, where s is how far one moves past the other and R how far apart their centres are.
    /// </summary>
    private bool CurvesAway(in SolverContact c, double seconds)
    {
        ref readonly SolverBody first = ref Problem.Bodies[c.First];
        bool isPair = c.Second != ContactPoint.Static;
        double reach = isPair ? first.Radius + Problem.Bodies[c.Second].Radius : surfaces.Reach(c.Surface, first.Radius);
        Vector3D velocity = isPair ? first.Velocity - Problem.Bodies[c.Second].Velocity : first.Velocity;
        return velocity.LengthSquared * seconds * seconds > 2 * reach * Scale.Length;
    }

    /// <summary>
    /// Whether two may touch in the step, and are then a contact of it: not what closes so fast that its rebound would rise by more than the tolerance, for which
    /// there are impacts.
    /// </summary>
    private bool MayTouch(double gap, double opening, double seconds, double restitution, double pull)
    {
        bool isNear = gap + (Math.Min(0, opening) * seconds) <= Scale.SpeculativeMargin;
        return isNear && (gap <= 0 || -opening * restitution <= Scale.CaptureSpeedAt(pull));
    }

    /// <summary>Finds the pairs of bodies that may touch, in no order.</summary>
    private void FindPairs(double seconds)
    {
        SortByPlace(out double widest);
        int count = Problem.BodyCount;
        for (int n = 0; n < count; n++)
        {
            int i = byPlace[n];
            ref readonly SolverBody p = ref Problem.Bodies[i];
            for (int k = n + 1; k < count && places[k] - places[n] <= widest; k++)
            {
                int j = byPlace[k];
                ref readonly SolverBody q = ref Problem.Bodies[j];
                Vector3D apart = members[i].Position - members[j].Position;
                Vector3D opens = p.Velocity - q.Velocity;
                double reach = p.Radius + q.Radius;
                double square = apart.LengthSquared;
                double along = Vector3D.Dot(apart, opens);
                double margin = reach + Math.Max(Scale.SpeculativeMargin, 2 * fastest * seconds);
                if (square > margin * margin || (p.InverseMass == 0 && q.InverseMass == 0))
                {
                    continue;
                }

                double length = Math.Sqrt(square);
                double opening = length > 0 ? along / length : opens.Y;
                bool mayTouch = MayTouch(
                    length - reach, opening, seconds, Math.Min(members[i].Restitution, members[j].Restitution), Math.Max(members[i].Pull, members[j].Pull));
                long pair = ((long)Math.Min(i, j) << 32) | (uint)Math.Max(i, j);
                if (mayTouch)
                {
                    Add(ref pairs, ref pairCount, pair);
                }
                else if (length - reach <= 2 * fastest * seconds)
                {
                    Add(ref near, ref nearCount, pair);
                }
            }
        }
    }

    private static void Add(ref long[] to, ref int count, long pair)
    {
        if (count == to.Length)
        {
            Array.Resize(ref to, Math.Max(1, 2 * count));
        }

        to[count++] = pair;
    }

    /// <summary>
    /// Marks the bodies that might strike another of the island within the step that was solved, which is no contact of it: for all others nobody need look.
    /// </summary>
    private void FindMeetings(double seconds)
    {
        bool isTooFast = false;
        for (int b = 0; b < Problem.BodyCount; b++)
        {
            members[b].MayMeet = false;
            isTooFast |= !(Problem.Bodies[b].Velocity.LengthSquared <= fastest * fastest);
        }

        for (int b = 0; b < Problem.BodyCount && isTooFast; b++)
        {
            members[b].MayMeet = true;
        }

        for (int n = 0; n < nearCount && !isTooFast; n++)
        {
            int i = (int)(near[n] >> 32);
            int j = (int)(uint)near[n];
            Vector3D apart = members[i].Position - members[j].Position;
            Vector3D opens = Problem.Bodies[i].Velocity - Problem.Bodies[j].Velocity;
            double reach = (Problem.Bodies[i].Radius + Problem.Bodies[j].Radius) * (1 + 1e-9);
            double along = Vector3D.Dot(apart, opens);
            double square = opens.LengthSquared;
            double nearest = along >= 0 ? 0 : square * seconds <= -along ? seconds : -along / square;
            if ((apart + (opens * nearest)).LengthSquared <= reach * reach)
            {
                members[i].MayMeet = true;
                members[j].MayMeet = true;
            }
        }
    }

    /// <summary>Whether a body might strike another of the island within the step.</summary>
    internal bool MayMeet(int body) => members[body].MayMeet;

    private void AddPair(int first, int second)
    {
        ref readonly Member a = ref members[first];
        ref readonly Member b = ref members[second];
        double p = Problem.Bodies[first].Radius;
        double q = Problem.Bodies[second].Radius;
        Vector3D apart = a.Position - b.Position;
        double length = apart.Length;
        double friction = Math.Min(a.Friction, b.Friction);
        double lever = Math.Max(Math.Min(a.Lever, friction * p), Math.Min(b.Lever, friction * q));
        ref SolverContact c = ref Problem.AddContact(first, second, -1, length > 0 ? apart / length : Vector3D.Up, length - (p + q), friction, lever);
        c.IsElastic = Math.Min(a.Restitution, b.Restitution) >= 1;
    }

    /// <summary>Numbers the bodies along the axis on which they are furthest apart; so far apart on it two may be that touch.</summary>
    private void SortByPlace(out double widest)
    {
        int count = Problem.BodyCount;
        Vector3D low = members[0].Position;
        Vector3D high = low;
        double speed = 0;
        double largest = 0;
        double pull = 0;
        for (int i = 0; i < count; i++)
        {
            Vector3D x = members[i].Position;
            low = new Vector3D(Math.Min(low.X, x.X), Math.Min(low.Y, x.Y), Math.Min(low.Z, x.Z));
            high = new Vector3D(Math.Max(high.X, x.X), Math.Max(high.Y, x.Y), Math.Max(high.Z, x.Z));
            largest = Math.Max(largest, Problem.Bodies[i].Radius);
            speed = Math.Max(speed, Problem.Bodies[i].Velocity.Length);
            pull = Math.Max(pull, members[i].Pull);
        }

        Vector3D span = high - low;
        for (int i = 0; i < count; i++)
        {
            Vector3D x = members[i].Position;
            places[i] = span.Y >= span.X && span.Y >= span.Z ? x.Y : span.X >= span.Z ? x.X : x.Z;
            byPlace[i] = i;
        }

        Array.Sort(places, byPlace, 0, count);
        fastest = speed + Scale.CaptureSpeedAt(pull);
        widest = (2 * largest) + Scale.SpeculativeMargin + (2 * fastest * Scale.Step.ToSeconds());
    }

    private struct Member
    {
        internal Vector3D Position;
        internal Vector3D Free; // the velocity without contacts
        internal Vector3D FreeSpin;
        internal bool MayMeet;
        internal double Friction;
        internal double Lever;
        internal double Restitution;
        internal double Pull;
    }
}
