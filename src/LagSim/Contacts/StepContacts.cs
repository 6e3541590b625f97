using System;
using LagSim.Scenes;

namespace LagSim.Contacts;

/// <summary>Finds the contacts of a contact step: pairs that touch, or might within the step, and are not left to impacts.</summary>
/// <remarks>Order counts: contacts are found in the order of their bodies. Cost: the pairs that are near along one axis.</remarks>
internal sealed class StepContacts(StaticSurfaces surfaces, ContactScale scale, ContactProblem problem, bool limitsCrowds)
{
    private readonly DeepestContacts deepest = new();
    private Member[] members = Array.Empty<Member>();
    private int[] byPlace = Array.Empty<int>();
    private double[] places = Array.Empty<double>();
    private long[] pairs = Array.Empty<long>(); // the lesser body and the greater
    private int pairCount;
    private long[] near = Array.Empty<long>(); // no contacts of the step, but they might come to touch if it makes them faster
    private int nearCount;
    private double fastest; // that the near ones were found for

    /// <summary>Notes a body that was added to the problem.</summary>
    /// <param name="body">Its number.</param>
    /// <param name="spec">The body's spec.</param>
    /// <param name="position">Where it is at the tick.</param>
    /// <param name="pull">How hard forces pull it, in m/s².</param>
    /// <param name="filter">What it collides with.</param>
    internal void SetBody(int body, in BodySpec spec, in Vector3D position, double pull, CollisionFilter filter)
    {
        if (body == members.Length)
        {
            Array.Resize(ref members, problem.Bodies.Length);
            Array.Resize(ref byPlace, problem.Bodies.Length);
            Array.Resize(ref places, problem.Bodies.Length);
        }

        members[body] = new Member
        {
            Position = position,
            Friction = spec.Friction,
            Lever = Math.Min(spec.RollingResistance, spec.Friction) * spec.Radius,
            Restitution = spec.Restitution,
            Pull = problem.Bodies[body].InverseMass > 0 ? pull : scale.Pull, // a hand presses as hard as is assumed of it
            Filter = filter,
        };
    }

    /// <summary>Finds what touches, or might within the step, among the bodies and with static surfaces.</summary>
    internal void Find(double seconds)
    {
        pairCount = 0;
        nearCount = 0;
        deepest.Clear();
        FindPairs(seconds);
        if (limitsCrowds && deepest.IsCrowd(problem.BodyCount))
        {
            LeaveOut();
        }

        Array.Sort(pairs, 0, pairCount);
        int next = 0;
        for (int i = 0; i < problem.BodyCount; i++)
        {
            FindSurfaces(i, seconds);
            for (; next < pairCount && (int)(pairs[next] >> 32) == i; next++)
            {
                AddPair(i, (int)(uint)pairs[next]);
            }
        }
    }

    /// <summary>Leaves out pairs that lie among deeper ones. Those that do not overlap yet may come to touch.</summary>
    private void LeaveOut()
    {
        deepest.Choose(problem.BodyCount);
        int kept = 0;
        for (int i = 0; i < pairCount; i++)
        {
            if (deepest.IsKept(i))
            {
                pairs[kept++] = pairs[i];
            }
            else if (!deepest.IsDeep(i, scale.SunkDepth))
            {
                Add(ref near, ref nearCount, pairs[i]);
            }
        }

        pairCount = kept;
    }

    /// <summary>
    /// Leaves out contacts that did not hold before and are left to impacts. These are elastic contacts, from which impacts take no energy,
    /// unless there is a hand, which gives and takes, or one of the two is deep in something: pushing it out does so too. And they are
    /// contacts past which the two move so fast that within the step the surfaces curve away by more than the tolerance: then the gap along
    /// the line between them does not show whether they touch.
    /// </summary>
    /// <param name="seconds">The length of the step.</param>
    internal void DropImpacts(double seconds)
    {
        bool hasHand = problem.HasHand();
        bool isMarked = false;
        int kept = 0;
        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            if (c.IsElastic && !isMarked)
            {
                MarkSunk();
                isMarked = true;
            }

            if (c.Held || !((c.IsElastic && !hasHand && !IsOfSunk(c)) || (c.Gap > 0 && CurvesAway(c, seconds))))
            {
                problem.Contacts[kept++] = c;
            }
            else if (c.Second != ContactPoint.Static)
            {
                Add(ref near, ref nearCount, ((long)c.First << 32) | (uint)c.Second);
            }
        }

        problem.Keep(kept);
    }

    /// <summary>Marks the bodies that are deeper than the tolerance in something.</summary>
    private void MarkSunk()
    {
        for (int b = 0; b < problem.BodyCount; b++)
        {
            members[b].IsSunk = false;
        }

        for (int i = 0; i < problem.ContactCount; i++)
        {
            ref readonly SolverContact c = ref problem.Contacts[i];
            if (c.Gap < -scale.Length)
            {
                members[c.First].IsSunk = true;
                members[c.Second == ContactPoint.Static ? c.First : c.Second].IsSunk = true;
            }
        }
    }

    private bool IsOfSunk(in SolverContact c) => members[c.First].IsSunk || (c.Second != ContactPoint.Static && members[c.Second].IsSunk);

    private void FindSurfaces(int i, double seconds)
    {
        ref readonly Member m = ref members[i];
        ref readonly SolverBody body = ref problem.Bodies[i];
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
            if (m.Filter.CollidesWith(surfaces.Filter(surface)) && MayTouch(gap, opening, seconds, restitution, m.Pull))
            {
                double friction = Math.Min(surfaces.Friction(surface), m.Friction);
                ref SolverContact c = ref problem.AddContact(i, ContactPoint.Static, surface, normal, gap, friction, Math.Min(m.Lever, friction * body.Radius));
                c.IsElastic = restitution >= 1;
            }
        }
    }

    /// <summary>
    /// Whether two bodies that pass each other are more than the tolerance further apart at the end of the step than the plane between them
    /// shows: by s^2 / 2R, where s is how far one moves past the other and R how far apart their centres are.
    /// </summary>
    private bool CurvesAway(in SolverContact c, double seconds)
    {
        ref readonly SolverBody first = ref problem.Bodies[c.First];
        bool isPair = c.Second != ContactPoint.Static;
        double reach = isPair ? first.Radius + problem.Bodies[c.Second].Radius : surfaces.Reach(c.Surface, first.Radius);
        Vector3D velocity = isPair ? first.Velocity - problem.Bodies[c.Second].Velocity : first.Velocity;
        return velocity.LengthSquared * seconds * seconds > 2 * reach * scale.Length;
    }

    /// <summary>
    /// Whether two may touch in the step, and so are a contact of it. A pair that closes so fast that its rebound would rise by more than
    /// the tolerance is left to impacts.
    /// </summary>
    private bool MayTouch(double gap, double opening, double seconds, double restitution, double pull)
    {
        bool isNear = gap + (Math.Min(0, opening) * seconds) <= scale.SpeculativeMargin;
        return isNear && (gap <= 0 || -opening * restitution <= scale.CaptureSpeedAt(pull));
    }

    /// <summary>Finds the pairs of bodies that may touch, in no order.</summary>
    private void FindPairs(double seconds)
    {
        SortByPlace(out double widest);
        int count = problem.BodyCount;
        for (int n = 0; n < count; n++)
        {
            int i = byPlace[n];
            ref readonly SolverBody p = ref problem.Bodies[i];
            for (int k = n + 1; k < count && places[k] - places[n] <= widest; k++)
            {
                int j = byPlace[k];
                ref readonly SolverBody q = ref problem.Bodies[j];
                Vector3D apart = members[i].Position - members[j].Position;
                Vector3D opens = p.Velocity - q.Velocity;
                double reach = p.Radius + q.Radius;
                double square = apart.LengthSquared;
                double along = Vector3D.Dot(apart, opens);
                double margin = reach + Math.Max(scale.SpeculativeMargin, 2 * fastest * seconds);
                if (square > margin * margin || (p.InverseMass == 0 && q.InverseMass == 0) || !members[i].Filter.CollidesWith(members[j].Filter))
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
                    deepest.Add((int)(pair >> 32), (int)(uint)pair, length - reach);
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
    /// Marks the bodies that might strike another member within the solved step although the pair is not a contact of it. All others need
    /// no test.
    /// </summary>
    internal void FindMeetings(double seconds)
    {
        bool isTooFast = false;
        for (int b = 0; b < problem.BodyCount; b++)
        {
            members[b].MayMeet = false;
            isTooFast |= !(problem.Bodies[b].Velocity.LengthSquared <= fastest * fastest);
        }

        for (int b = 0; b < problem.BodyCount && isTooFast; b++)
        {
            members[b].MayMeet = true;
        }

        for (int n = 0; n < nearCount && !isTooFast; n++)
        {
            int i = (int)(near[n] >> 32);
            int j = (int)(uint)near[n];
            Vector3D apart = members[i].Position - members[j].Position;
            Vector3D opens = problem.Bodies[i].Velocity - problem.Bodies[j].Velocity;
            double reach = (problem.Bodies[i].Radius + problem.Bodies[j].Radius) * (1 + 1e-9);
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
        double p = problem.Bodies[first].Radius;
        double q = problem.Bodies[second].Radius;
        Vector3D apart = a.Position - b.Position;
        double length = apart.Length;
        double friction = Math.Min(a.Friction, b.Friction);
        double lever = Math.Max(Math.Min(a.Lever, friction * p), Math.Min(b.Lever, friction * q));
        ref SolverContact c = ref problem.AddContact(first, second, -1, length > 0 ? apart / length : Vector3D.Up, length - (p + q), friction, lever);
        c.IsElastic = Math.Min(a.Restitution, b.Restitution) >= 1;
    }

    /// <summary>Numbers the bodies along the axis on which they are furthest apart; so far apart on it two may be that touch.</summary>
    private void SortByPlace(out double widest)
    {
        int count = problem.BodyCount;
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
            largest = Math.Max(largest, problem.Bodies[i].Radius);
            speed = Math.Max(speed, problem.Bodies[i].Velocity.Length);
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
        fastest = speed + Math.Max(scale.CaptureSpeed, scale.CaptureSpeedAt(pull));
        widest = (2 * largest) + scale.SpeculativeMargin + (2 * fastest * scale.Step.ToSeconds());
    }

    private struct Member
    {
        internal Vector3D Position;
        internal bool MayMeet;
        internal bool IsSunk;
        internal double Friction;
        internal double Lever;
        internal double Restitution;
        internal double Pull;
        internal CollisionFilter Filter;
    }
}
