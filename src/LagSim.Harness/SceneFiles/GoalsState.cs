namespace LagSim.Harness.SceneFiles;

/// <summary>The state of <see cref="GoalsRules"/>, of the world.</summary>
public struct GoalsState
{
    /// <summary>When the last goal was, in ticks since the start; 0 before the first.</summary>
    public long LastGoalTicks;

    /// <summary>When the last command was that counted, in ticks since the start; 0 before the first.</summary>
    public long LastCommandTicks;

    /// <summary>The power-up that lies there, by its packed identity; 0 for none.</summary>
    public ulong PowerUp;

    /// <summary>The goals of the left side: balls that came into the goal on the right.</summary>
    public int Left;

    /// <summary>The goals of the right side.</summary>
    public int Right;

    /// <summary>How many half seconds the count-down still has; 0 once the play goes on.</summary>
    public int CountDown;

    /// <summary>1 once the whistle has blown; goals then count no more.</summary>
    public int IsOver;

    /// <summary>How many power-ups were taken.</summary>
    public int PowerUpsTaken;

    /// <summary>How often players cheered.</summary>
    public int Cheers;

    /// <summary>How often players had a ball kicked.</summary>
    public int Kicks;

    /// <summary>Commands that are none, or came after the end.</summary>
    public int Ignored;
}
