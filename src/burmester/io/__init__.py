"""Files and screens: tasks in (`reading`), results out.

Out: tables (`terminal`, `linkage_table`), messages (`message`, `explain`), JSON
(`result`, `linkage_data`), a task before it is solved (`overview`); `files` writes them whole.
In again: `saved`.  Carried along: `cases` and `templates`.  Nothing is imported here, so that
asking for their names stays cheap.
"""
