using System;
using System.Threading;
using LagSim.Time;

namespace LagSim.Contacts;

/// <summary>Steps of islands that other threads take before they are due, while this one is busy with other islands.</summary>
/// <remarks>
/// <para>A step is a pure function of who takes part, from what state, and when. So it may be taken ahead, from what it will be if nothing happens before; when
/// it is due, and still is of just that, to the bit, what was taken is used, else it is taken anew. What comes of it is the same on any number of
/// threads.</para>
/// <para>A step that no thread has begun by then is taken by the one that needs it, which so never waits for a thread that is not there. All but the taking
/// itself is done by the simulation's thread. Allocates nothing once its steps have grown to their islands.</para>
/// </remarks>
internal sealed class StepsAhead
{
    /// <summary>So many steps at most are kept for each thread that may help.</summary>
    private const int PerThread = 4;

    private static readonly WaitCallback Run = job => ((Job)job!).Run();

    private readonly Job[] jobs;
    private readonly Action<WaitCallback, object> queue;

    /// <summary>No steps yet.</summary>
    /// <param name="helpers">How many threads may help, at least one.</param>
    /// <param name="create">Makes a step.</param>
    /// <param name="queue">Has something done on another thread, some time; by default the pool's.</param>
    internal StepsAhead(int helpers, Func<IslandStep> create, Action<WaitCallback, object>? queue = null)
    {
        jobs = new Job[Math.Min(helpers, 8) * PerThread];
        for (int i = 0; i < jobs.Length; i++)
        {
            jobs[i] = new Job(create());
        }

        this.queue = queue ?? ((run, job) => ThreadPool.UnsafeQueueUserWorkItem(run, job));
    }

    /// <summary>Uses a step that is due then of as many bodies and contacts, whatever states it was taken from: a negative control that a test sets.</summary>
    internal bool TakesAnyState { get; set; }

    /// <summary>How many steps were used that had been taken ahead.</summary>
    internal long Used { get; private set; }

    /// <summary>A place for a step to be filled and begun, of which nothing else is kept any more; false if all are in use.</summary>
    /// <param name="now">Steps that were due before are of no use.</param>
    /// <param name="job">Its step has nobody in it.</param>
    internal bool TryRent(SimTime now, out Job job)
    {
        for (int i = 0; i < jobs.Length; i++)
        {
            job = jobs[i];
            if (job.State == Job.Idle || (job.Due < now && job.TryDrop()))
            {
                job.Step.Clear();
                return true;
            }
        }

        job = null!;
        return false;
    }

    /// <summary>Has the step of a rented place taken.</summary>
    internal void Begin(Job job, SimTime due, double closing)
    {
        job.Begin(due, closing);
        queue(Run, job);
    }

    /// <summary>Puts in place of a step that is due the same one as it was taken ahead; false if nobody has taken it.</summary>
    internal bool TryUse(ref IslandStep step, SimTime due)
    {
        for (int i = 0; i < jobs.Length; i++)
        {
            Job job = jobs[i];
            if (job.State != Job.Idle && job.Due == due && IsRight(job.Step, step) && !job.TryDropUnbegun())
            {
                (step, job.Step) = (job.WhenDone(), step);
                Used++;
                return true;
            }
        }

        return false;
    }

    private bool IsRight(IslandStep taken, IslandStep step) =>
        TakesAnyState ? taken.BodyCount == step.BodyCount && taken.ContactCount == step.ContactCount : taken.IsFrom(step);

    /// <summary>A place for a step that is, will be or was taken.</summary>
    internal sealed class Job
    {
        internal const int Idle = 0;
        private const int Queued = 1;
        private const int Running = 2;
        private const int Done = 3;

        private int state;
        private double closing;

        internal Job(IslandStep step) => Step = step;

        internal IslandStep Step { get; set; }

        internal SimTime Due { get; private set; }

        internal int State => Volatile.Read(ref state);

        internal void Begin(SimTime due, double closing)
        {
            Due = due;
            this.closing = closing;
            Volatile.Write(ref state, Queued);
        }

        /// <summary>On any thread: takes the step, unless it was dropped, or is being taken.</summary>
        internal void Run()
        {
            if (Interlocked.CompareExchange(ref state, Running, Queued) == Queued)
            {
                Step.Take(Due, closing);
                Volatile.Write(ref state, Done);
            }
        }

        internal bool TryDropUnbegun() => Interlocked.CompareExchange(ref state, Idle, Queued) == Queued;

        /// <summary>Nothing of it is needed any more; false while it is being taken.</summary>
        internal bool TryDrop() => TryDropUnbegun() || Interlocked.CompareExchange(ref state, Idle, Done) == Done;

        internal IslandStep WhenDone()
        {
            SpinWait wait = default;
            while (State == Running)
            {
                wait.SpinOnce();
            }

            Volatile.Write(ref state, Idle);
            return Step;
        }
    }
}
